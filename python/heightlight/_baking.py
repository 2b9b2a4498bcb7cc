"""Bakes material maps."""

from __future__ import annotations

import json
import os
from typing import Any, Iterable, Optional, Union

import numpy as np

from . import _native
from ._heights import HeightLike, numbers, surface_of
from ._settings import integer, one_of, max_distance_of, settings


class Bake(dict):
    """What `bake()` returns: a dict of maps by name, as float32 arrays (rows, columns) or (rows, columns, channels).

    Attributes:
        evidence: a dict that says how the maps were computed and what their errors are.
    """

    def __init__(self, native: Any, names: Iterable[str]) -> None:
        super().__init__({name: native.map(name) for name in names})
        self._native = native

    @property
    def evidence(self) -> dict[str, Any]:
        """How the maps were computed, and what their errors are."""
        return json.loads(self._native.evidence)

    def save(
        self,
        folder: Union[str, os.PathLike],
        name: str = "material",
        *,
        format: str = "png",
        depth: Union[int, str, None] = None,
    ) -> list[str]:
        """Writes the maps to files, as `heightlight bake` does, with NAME_bake.json beside them.

        Either all files appear or none.

        Args:
            folder: where to write the files.
            name: the beginning of the files' names (NAME).
            format: "png", "exr" or "tif".
            depth: 8, 16, "half" or "float"; None: 16 for PNG, float for the other formats.

        Returns:
            The names of the files.
        """
        return self._native.save(os.fspath(folder), str(name), str(format), "" if depth is None else str(depth))


def maps() -> dict[str, str]:
    """The maps that `bake` can make: a dict from name to description."""
    return _native.material_maps()


def map_names(maps: Union[str, Iterable[str]]) -> list[str]:
    return [maps] if isinstance(maps, str) else [str(name) for name in maps]


def bake_choice(
    albedo: Any,
    *,
    max_distance: Any = None,
    falloff: Any = "none",
    uniform_ao: Any = False,
    y_down: Any = False,
    horizon_azimuths: Any = 4,
    azimuth_convention: Any = None,
    below_horizontal: Any = "sky",
) -> dict[str, Any]:
    """Checks those arguments of `bake` that choose the content of maps, and converts them for the compiled part.
    Raises ValueError."""
    reflectance = numbers("albedo", albedo)
    if reflectance.ndim > 1 or reflectance.size not in (1, 3):
        raise ValueError("albedo: must be one number, or three")
    distance, fading = max_distance_of(max_distance, falloff)
    choice: dict[str, Any] = {
        "albedo": [float(value) for value in np.atleast_1d(reflectance)],
        "max_distance": distance,
        "falloff": fading,
        "uniform_ao": bool(uniform_ao),
        "y_down": bool(y_down),
        "horizon_azimuths": integer("horizon_azimuths", horizon_azimuths, 1, 360),
    }
    if azimuth_convention is not None:
        choice["azimuth_convention"] = one_of("azimuth_convention", azimuth_convention, ("north", "math"))
    choice["below_horizontal"] = one_of("below_horizontal", below_horizontal, ("sky", "ground"))
    return choice


def bake(
    height: HeightLike,
    maps: Union[str, Iterable[str]] = ("ao",),
    *,
    texel: Any = None,
    boundary: Optional[str] = None,
    albedo: Any = 0.5,
    error: float = 2e-3,
    azimuths: Optional[int] = None,
    max_distance: Optional[float] = None,
    falloff: str = "none",
    uniform_ao: bool = False,
    y_down: bool = False,
    horizon_azimuths: int = 4,
    azimuth_convention: Optional[str] = None,
    below_horizontal: str = "sky",
    roughness: float = 0.13,
    view: Iterable[float] = (0, 0, 1),
    seed: int = 1,
    threads: Optional[int] = None,
    memory: Optional[int] = None,
    progress: Any = False,
) -> Bake:
    """Bakes maps of a material; all are computed together.

    Args:
        height: heights, as for `sky()`.
        maps: one name or several, of "ao", "multibounce", "bent-normal", "bent-cone", "normal", "ao-n", "horizon",
            "sh", "height", "specular-occlusion", and the names of `definitions()`. `maps()` describes each.
        albedo: for multibounce, one number or three (red, green, blue).
        uniform_ao: True stores α as the ambient occlusion instead of A.
        y_down: True stores vectors with y pointing down the image, as Direct3D has them.
        horizon_azimuths: number of azimuths of the horizon map, 1 to 360.
        azimuth_convention: how azimuths of the horizon map count: "north", clockwise from north, or "math", from x
            toward y. None: "north" on open maps, "math" on maps that tile.
        roughness: for specular-occlusion, GGX's alpha.
        view: for specular-occlusion, the vector (x, y, z) toward the viewer, z > 0.

    The other arguments are those of `sky()`.

    Returns:
        A `Bake`: the maps by name.

    Raises:
        ValueError: for arguments that make no sense.
        MemoryError: if the work does not fit in memory; raised before the memory is taken.
    """
    names = map_names(maps)
    surface, _ = surface_of(height, texel, boundary)
    choice = bake_choice(
        albedo,
        max_distance=max_distance,
        falloff=falloff,
        uniform_ao=uniform_ao,
        y_down=y_down,
        horizon_azimuths=horizon_azimuths,
        azimuth_convention=azimuth_convention,
        below_horizontal=below_horizontal,
    )
    choice["roughness"] = float(roughness)
    choice["view"] = [float(component) for component in view]
    if len(choice["view"]) != 3:
        raise ValueError("view: must be a vector, x, y and z, toward the viewer")
    chosen = settings(error, azimuths, None, seed, threads, memory, progress)
    return Bake(_native.Bake(surface, chosen, names, choice), names)
