"""Material maps."""

from __future__ import annotations

import json
import os
from typing import Any, Iterable, Optional, Union

import numpy as np

from . import _native
from ._heights import HeightLike, numbers, surface_of
from ._settings import integer, one_of, max_distance_of, settings


class Bake(dict):
    """Maps by name, float32 arrays: (rows, columns), or (rows, columns, channels). `evidence` says how they were
    found and what they err by."""

    def __init__(self, native: Any, names: Iterable[str]) -> None:
        super().__init__({name: native.map(name) for name in names})
        self._native = native

    @property
    def evidence(self) -> dict[str, Any]:
        return json.loads(self._native.evidence)

    def save(
        self,
        folder: Union[str, os.PathLike],
        name: str = "material",
        *,
        format: str = "png",
        depth: Union[int, str, None] = None,
    ) -> list[str]:
        """Writes the maps as `heightlight bake` does, with NAME_bake.json beside them; all or none. Names of the
        files are returned. `depth`: 8, 16, "half" or "float"; 16 of PNG and float of others where None."""
        return self._native.save(os.fspath(folder), str(name), str(format), "" if depth is None else str(depth))


def maps() -> dict[str, str]:
    """What `bake` can make: name and description."""
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
    """What maps are made of and how, as the compiled part takes it; `bake` says what is what. Raises ValueError."""
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
    """Maps of a material: "ao", "multibounce", "bent-normal", "bent-cone", "normal", "ao-n", "horizon", "sh",
    "height", "specular-occlusion", and the definitions of `definitions()` (`maps()` says what each is), found together.

    `albedo` is of multibounce: one number or three. `uniform_ao`: α in place of A. `y_down`: vectors as Direct3D
    has them. `azimuth_convention`: horizons count "north", clockwise, or "math", from x toward y; where None,
    north on open maps. `roughness` (GGX's alpha) and `view` (x, y, z toward the viewer, z > 0) are of
    specular-occlusion. Other arguments as those of `sky()`.
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
