"""Heights: from arrays, files and shapes."""

from __future__ import annotations

import os
import warnings
from typing import Any, Optional, Sequence, Union

import numpy as np

from . import _native
from ._settings import integer, real


class Heightmap:
    """Heights with their spacing and boundary; an array wherever one is wanted.

    Attributes:
        height: (rows, columns) float32, world units, NaN where the sample is missing.
        texel: (x, y), distance between samples, world units.
        boundary: "tile" (the map repeats) or "open" (beyond it there is nothing).
        base: world height of 0 in `height`.
        curvature: None, or the refraction k, usually 0.13: heights are lowered by the Earth's curvature about
            the map's middle where light is found on them. World units are metres, the boundary is "open".
        facts: of the file that it was read from; empty otherwise.
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
    """float32 stays as it lies, all else becomes float64; masked samples are NaN. Raises ValueError for what are
    no real numbers."""
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
    """One number or (x, y); where there is none, so that the columns span a width of 1."""
    if texel is None:
        return (1.0 / height.shape[1],) * 2 if height.ndim == 2 and height.shape[1] > 0 else (1.0, 1.0)
    values = np.asarray(texel)
    if values.dtype.kind not in "fiu" or values.size not in (1, 2):
        raise ValueError(f"texel {texel!r}: must be one spacing, or (x, y)")
    x, y = (float(value) for value in np.broadcast_to(values.reshape(-1), 2))
    return x, y


def surface_of(height: Any, texel: Any, boundary: Any) -> tuple[Any, Heightmap]:
    """The compiled surface, and what it was made of. Arguments that are given win over a Heightmap's own."""
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
    """A shape of the project's own: brick, cobbles, concrete, fbm, bowl and others (`shapes()` lists them).

    Heights run from 0 to `relief`, `size` × `size` of them over a square of side `width`. The same for the same
    arguments on every machine.
    """
    size = integer("size", size, 1, 32768)
    heights = _native.synth(str(shape), size, integer("seed", seed, 0, 2**64 - 1))
    heights = (heights.astype(np.float64) * real("relief", relief)).astype(np.float32)
    tiles = _native.shapes()[shape][1]
    return Heightmap(heights, real("width", width) / size, "tile" if tiles else "open")


def shapes() -> dict[str, str]:
    """What `synth` can make: name and description."""
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
    """How a file becomes heights, as the compiled part takes it; `read` says what is what."""
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
    """A heightmap from a file: PNG, EXR, TIFF, Esri ASCII grid, JPEG, TGA, HDR, .npy, SRTM's .hgt, or raw samples.

    Integer samples are levels without a unit: they are stretched to `relief`, or `relief_share` of the width (a
    tenth). Float samples are heights as they are. `texel` (one spacing or (x, y)) or `width` says how far apart
    samples are; a GeoTIFF and an Esri grid say so themselves, and "auto" turns degrees into metres. `scale` and
    `offset` make heights of levels: height per stored value, and of a stored 0. Raw samples want their `size` (rows,
    columns), and `big_endian` where their highest byte comes first. `curvature` as Heightmap has it. What a user should know of the file is warned of.

    Raises OSError naming the file that cannot be read, ValueError for arguments that make no sense.
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
    """Radiance of a sky, latitude by longitude, (rows, 2 rows, 3) float32, from an EXR or HDR image. Its middle
    looks to +y, its upper edge is the zenith. Raises OSError naming the file."""
    return _native.read_sky(os.fspath(path))
