"""What texels see of the sky."""

from __future__ import annotations

import json
from typing import Any, Optional, Sequence, Union

import numpy as np

from . import _native
from ._heights import HeightLike, surface_of
from ._settings import integer, one_of, max_distance_of, real, settings


class Sky:
    """What `sky()` returns. Each quantity is found when it is first asked for, and kept."""

    def __init__(self, surface: Any, chosen: Any, max_distance: Optional[float], falloff: str, below: str = "sky") -> None:
        self._surface = surface
        self._settings = chosen
        self._task = (max_distance, falloff, below)
        self._shares: Optional[dict[str, Any]] = None
        self._moments: Optional[dict[str, Any]] = None
        self._definitions: dict[str, np.ndarray] = {}

    def _found(self) -> dict[str, Any]:
        if self._shares is None:
            self._shares = _native.sky(self._surface, self._settings, False, *self._task)
        return self._shares

    def _found_moments(self) -> dict[str, Any]:
        if self._moments is None:
            self._moments = _native.sky(self._surface, self._settings, True, *self._task)
        return self._moments

    @property
    def sky_view_factor(self) -> np.ndarray:
        """A = (1/π) ∫ V cosθ dω, (rows, columns) float32 in [0, 1]; 1 = open. GTAO's AO."""
        return self._found()["sky_view_factor"]

    @property
    def ambient_occlusion(self) -> np.ndarray:
        """α = (1/2π) ∫ V dω, (rows, columns) float32 in [0, 1]; 1 = open. The study notes' AO."""
        return self._found()["ambient_occlusion"]

    @property
    def bent_normal(self) -> np.ndarray:
        """Unit vectors along ∫ V ω cosθ dω, (rows, columns, 3) float32; the normal where no sky is seen."""
        return self._found_moments()["bent_normal"]

    @property
    def moments(self) -> tuple[np.ndarray, np.ndarray]:
        """(1/π) ∫ V f(ω) cosθ dω: of f = ω, (rows, columns, 3), and of x² − y², xy, z², xz, yz, (rows, columns,
        5); float32. Spherical harmonics of order 2 follow from them and A."""
        found = self._found_moments()
        return found["first"], found["second"]

    def definition(self, name: str) -> np.ndarray:
        """What terrain science calls by that name, (rows, columns) float32: "svf-tilted" (A), "svf-horizontal",
        "svf-solid-angle", "openness-positive" and "openness-negative" (rad), "mean-cos-h", "terrain-view-factor".
        `definitions()` has their formulas. Found to the error wanted of A. Raises ValueError for other names."""
        if name not in self._definitions:
            found = _native.definitions(self._surface, self._settings, [str(name)], *self._task)
            self._definitions[name] = found["definitions"][0]
        return self._definitions[name]

    def horizons(self, azimuths: Union[int, Sequence[float]], convention: str = "math") -> np.ndarray:
        """Elevations of the horizon, rad, at least those of the tangent plane: (azimuths, rows, columns) float32.

        `azimuths`: how many, at 2π k/N; or the angles themselves, rad. They count from x toward y ("math"), or
        clockwise from north, which is y ("north").
        """
        angles = angles_of(azimuths)
        if one_of("convention", convention, ("math", "north")) == "north":
            angles = [np.pi / 2 - angle for angle in angles]
        if not angles or not np.all(np.isfinite(angles)):
            raise ValueError("azimuths: must be finite angles, at least one")
        return _native.horizons(self._surface, self._settings, angles, *self._task)["horizons"]

    @property
    def evidence(self) -> dict[str, Any]:
        """How A was found, what it errs by against exact walks, and what that cost."""
        found = self._moments if self._shares is None and self._moments is not None else self._found()
        return json.loads(found["evidence"])


def definitions() -> dict[str, str]:
    """What `Sky.definition` can find: name and formula. h is the elevation of the horizon above a place's own
    horizontal; means are over azimuths."""
    return _native.sky_definitions()


def angles_of(azimuths: Any) -> list[float]:
    """So many at 2π k/N, or those given, rad."""
    if np.ndim(azimuths) == 0:
        count = integer("azimuths", azimuths, 1, 65536)
        return [2 * np.pi * k / count for k in range(count)]
    return [real("azimuths", angle) for angle in azimuths]


def sky(
    height: HeightLike,
    *,
    texel: Any = None,
    boundary: Optional[str] = None,
    error: float = 1e-3,
    azimuths: Optional[int] = None,
    rays: Optional[int] = None,
    max_distance: Optional[float] = None,
    falloff: str = "none",
    below_horizontal: str = "sky",
    seed: int = 1,
    threads: Optional[int] = None,
    memory: Optional[int] = None,
    progress: Any = False,
) -> Sky:
    """What every texel sees of the sky, found when it is asked for.

    Args:
        height: (rows, columns) of numbers, world units, row 0 on top; NaN is missing. Or a Heightmap.
        texel: distance between samples, world units: one number or (x, y). Without it the columns span 1.
        boundary: "tile" or "open"; a Heightmap's own, else "tile".
        error: RMSE wanted of A; 0: exact slices, far slower.
        azimuths: of the walk, an even number; chosen for the error where it is None.
        rays: by so many rays per texel, the reference, in place of horizon walks.
        max_distance: occluders count up to this distance, world units; `falloff` ("none", "linear", "sqrt",
            "exponential") says how they fade toward it.
        below_horizontal: what lies there in directions that miss the surface: "sky", or "ground", which does not
            shine, as terrain tools have it: A of a plane tilted by S is then (1 + cos S)/2.
        seed: of every random choice. threads: where None, as OMP_NUM_THREADS says, or one per processor that
            this process may use, by its affinity and its control group's quota; results do not depend on it.
        memory: bytes that may be taken beside what the process holds already (of the command's --memory, the
            part that is not the program itself). Where None, four fifths of what the machine has free, of
            what the control group leaves, or of what RLIMIT_AS leaves, whichever is least.
        progress: True shows bars where tqdm is installed; or a function of (name, done, total, ended).

    Raises:
        ValueError: for what makes no sense. MemoryError: for what memory does not hold, before it is taken.

    Ambient occlusion: Jimenez, Wu, Pesce and Jarabo, "Practical Realtime Strategies for Accurate Indirect
    Occlusion" (2016), whose AO is A.
    """
    surface, _ = surface_of(height, texel, boundary)
    chosen = settings(error, azimuths, rays, seed, threads, memory, progress)
    below = one_of("below_horizontal", below_horizontal, ("sky", "ground"))
    return Sky(surface, chosen, *max_distance_of(max_distance, falloff), below)
