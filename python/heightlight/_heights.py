"""Heights from arrays, files and synthetic shapes."""

from __future__ import annotations

import os
import warnings
from typing import Any, Optional, Sequence, Union

import numpy as np

from . import _native
from ._settings import integer, real


class Heightmap:
    """Heights with their spacing and boundary. NumPy functions accept it as an array.

    Attributes:
        height: (rows, columns) float32, world units, NaN where the sample is missing.
        texel: (x, y), distances between samples, world units.
        boundary: "tile" (the map repeats) or "open" (there is nothing beyond its edge).
        base: world height of a 0 in `height`.
        curvature: None, or the refraction coefficient k, usually 0.13. With it, computations lower the heights by the
            Earth's curvature about the map's middle; world units must be metres, and the boundary "open".
        facts: a dict of facts about the file that the heights were read from; empty otherwise.
    """

    def __init__(
        self,
        height: Any,
        texel: Any = None,
        boundary: str = "tile",
        *,
        base: float = 0.0,
        curvature: Optional[float] = None,
        facts: Optional[dict[str, Any]] = None,
    ) -> None:
        self.height = numbers("height", height)
        if self.height.ndim != 2:
            raise ValueError(f"height: has {self.height.ndim} dimensions, and must have two")
        self.texel = spacing(texel, self.height)
        self.boundary = str(boundary)
        self.base = float(base)
        self.curvature = None if curvature is None else real("curvature", curvature)
        self.facts = dict(facts or {})

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, columns)."""
        rows, columns = self.height.shape
        return rows, columns

    def __array__(self, dtype: Any = None) -> np.ndarray:
        return self.height if dtype is None else self.height.astype(dtype)

    def __repr__(self) -> str:
        rows, columns = self.shape
        x, y = self.texel
        return f"<heightlight.Heightmap {rows} × {columns}, texel {x:g} × {y:g}, {self.boundary}>"


HeightLike = Union[Heightmap, np.ndarray, Sequence[Sequence[float]]]


def numbers(name: str, values: Any) -> np.ndarray:
    """Converts values to an array. float32 is returned without a copy, everything else becomes float64; masked samples
    become NaN. Raises ValueError for values that are not real numbers."""
    if isinstance(values, np.ma.MaskedArray):
        values = np.ma.filled(values.astype(np.float64), np.nan)
    try:
        array = np.asarray(values)
    except ValueError:
        raise ValueError(f"{name}: is no rectangle of numbers") from None
    if array.dtype.kind not in "fiub":
        raise ValueError(f"{name}: holds {array.dtype}, and must hold real numbers")
    if array.dtype == np.float32 and array.dtype.isnative:
        return array
    return array.astype(np.float64)


def spacing(texel: Any, height: np.ndarray) -> tuple[float, float]:
    """The spacing (x, y) from one number or (x, y). Without it, the columns span a width of 1."""
    if texel is None:
        return (1.0 / height.shape[1],) * 2 if height.ndim == 2 and height.shape[1] > 0 else (1.0, 1.0)
    values = np.asarray(texel)
    if values.dtype.kind not in "fiu" or values.size not in (1, 2):
        raise ValueError(f"texel {texel!r}: must be one spacing, or (x, y)")
    x, y = (float(value) for value in np.broadcast_to(values.reshape(-1), 2))
    return x, y


def surface_of(height: Any, texel: Any, boundary: Any) -> tuple[Any, Heightmap]:
    """The compiled surface, and the Heightmap that it was made of. Given arguments replace those of a Heightmap."""
    if isinstance(height, Heightmap):
        map = height
        if texel is not None or boundary is not None:
            map = Heightmap(
                height.height,
                height.texel if texel is None else texel,
                boundary or height.boundary,
                base=height.base,
                curvature=height.curvature,
            )
    else:
        map = Heightmap(height, texel, "tile" if boundary is None else boundary)
    x, y = map.texel
    return _native.Surface(map.height, x, y, map.boundary, map.curvature), map


def synth(shape: str, size: int = 512, *, seed: int = 1, relief: float = 0.1, width: float = 1.0) -> Heightmap:
    """Makes a synthetic shape: brick, cobbles, concrete, fbm, bowl and others (`shapes()` lists them).

    The result depends on the arguments alone, not on the machine.

    Args:
        shape: name of the shape.
        size: number of rows and of columns, 1 to 32768.
        seed: seed of the random numbers.
        relief: heights run from 0 to this, world units.
        width: side of the square that the map covers, world units.
    """
    size = integer("size", size, 1, 32768)
    heights = _native.synth(str(shape), size, integer("seed", seed, 0, 2**64 - 1))
    heights = (heights.astype(np.float64) * real("relief", relief)).astype(np.float32)
    tiles = _native.shapes()[shape][1]
    return Heightmap(heights, real("width", width) / size, "tile" if tiles else "open")


def shapes() -> dict[str, str]:
    """The shapes that `synth` can make: a dict from name to description."""
    return {name: description for name, (description, _) in _native.shapes().items()}


def load_options(
    *,
    relief: Any = None,
    relief_share: Any = None,
    width: Any = None,
    texel: Any = None,
    boundary: Any = None,
    no_data: Any = None,
    part: Any = None,
    channel: Any = None,
    size: Any = None,
    big_endian: Any = False,
    scale: Any = None,
    offset: Any = None,
    shrink: Any = 1,
    invert: Any = False,
) -> dict[str, Any]:
    """Checks the arguments of `read`, and converts them for the compiled part."""
    options: dict[str, Any] = {"shrink": integer("shrink", shrink, 1), "invert": bool(invert)}
    for name, value in (("relief", relief), ("relief_share", relief_share), ("width", width), ("no_data", no_data), ("scale", scale), ("offset", offset)):
        if value is not None:
            options[name] = real(name, value)
    for name, text in (("part", part), ("channel", channel), ("boundary", boundary)):
        if text is not None:
            options[name] = str(text)
    if boundary not in (None, "tile", "open"):
        raise ValueError(f"boundary {boundary}: must be tile or open")
    if size is not None:
        rows, columns = size
        options["size"] = (integer("size", rows, 1), integer("size", columns, 1))
    options["big_endian"] = bool(big_endian)
    if isinstance(texel, str) and texel == "auto":
        options["texel"] = texel
    elif texel is not None:
        options["texel"] = spacing(texel, np.empty((1, 1)))
    return options


def read(
    path: Union[str, os.PathLike],
    *,
    relief: Optional[float] = None,
    relief_share: Optional[float] = None,
    width: Optional[float] = None,
    texel: Any = None,
    boundary: Optional[str] = None,
    no_data: Optional[float] = None,
    part: Optional[str] = None,
    channel: Optional[str] = None,
    size: Optional[tuple[int, int]] = None,
    big_endian: bool = False,
    scale: Optional[float] = None,
    offset: Optional[float] = None,
    shrink: int = 1,
    invert: bool = False,
    curvature: Optional[float] = None,
) -> Heightmap:
    """Reads a heightmap from a file: PNG, EXR, TIFF, Esri ASCII grid, JPEG, TGA, HDR, .npy, SRTM's .hgt, or raw samples.

    Integer samples without a unit are levels, which are stretched to a relief. Float samples are heights as they are.
    Oddities of the file are reported as Python warnings.

    Args:
        path: the file.
        relief: relief to which heights are stretched, world units.
        relief_share: the same, as a fraction of the width. Levels are stretched to 0.1 of the width if neither is
            given.
        width: world width of the map, which determines the distance between samples.
        texel: distance between samples, world units: one number or (x, y). A GeoTIFF and an Esri grid give it
            themselves; "auto" turns degrees into metres.
        boundary: "tile" or "open". None: "open" for a file that gives its spacing, else "tile".
        no_data: the stored value that means missing, besides the one that the file names.
        part: part of an EXR, by name or by number from 0.
        channel: channel, by name or by number from 0.
        size: (rows, columns), for raw samples only.
        big_endian: whether the highest byte of raw samples comes first.
        scale: height per stored value.
        offset: height of a stored 0.
        shrink: averages shrink × shrink samples into one.
        invert: True if larger stored values are lower.
        curvature: as in `Heightmap`.

    Raises:
        OSError: naming the file, if it cannot be read.
        ValueError: for arguments that make no sense.
    """
    options = load_options(
        relief=relief,
        relief_share=relief_share,
        width=width,
        texel=texel,
        boundary=boundary,
        no_data=no_data,
        part=part,
        channel=channel,
        size=size,
        big_endian=big_endian,
        scale=scale,
        offset=offset,
        shrink=shrink,
        invert=invert,
    )
    found = _native.read(os.fspath(path), options)
    for warning in found["warnings"]:
        warnings.warn(f"{path}: {warning}", stacklevel=2)
    return Heightmap(
        found["heights"],
        found["texel"],
        found["boundary"],
        base=found["base"],
        curvature=curvature,
        facts=found["facts"],
    )


def read_sky(path: Union[str, os.PathLike]) -> np.ndarray:
    """Reads the radiance of a sky by latitude and longitude, (rows, 2 rows, 3) float32, from an EXR or HDR image.

    The middle of the image looks toward +y; its upper edge is the zenith. Raises OSError naming the file.
    """
    return _native.read_sky(os.fspath(path))
