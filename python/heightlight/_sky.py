"""The part of the sky that each texel sees."""

from __future__ import annotations

import json
from typing import Any, Optional, Sequence, Union

import numpy as np

from . import _native
from ._heights import HeightLike, surface_of
from ._settings import integer, one_of, max_distance_of, real, settings


class Sky:
    """What `sky()` returns. Each quantity is computed when it is first asked for, and then kept."""

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
        """A = (1/π) ∫ V cosθ dω, (rows, columns) float32 in [0, 1]; 1 = open. This is GTAO's AO."""
        return self._found()["sky_view_factor"]

    @property
    def ambient_occlusion(self) -> np.ndarray:
        """α = (1/2π) ∫ V dω, (rows, columns) float32 in [0, 1]; 1 = open. This is the AO of
        Patapom's notes."""
        return self._found()["ambient_occlusion"]

    @property
    def bent_normal(self) -> np.ndarray:
        """Unit vectors along ∫ V ω cosθ dω, (rows, columns, 3) float32; the normal where no sky is visible."""
        return self._found_moments()["bent_normal"]

    @property
    def moments(self) -> tuple[np.ndarray, np.ndarray]:
        """The moments (1/π) ∫ V f(ω) cosθ dω, float32, as two arrays.

        The first is for f = ω, (rows, columns, 3); the second for f = x² − y², xy, z², xz, yz, (rows, columns, 5).
        Spherical harmonics of order 2 follow from them and A.
        """
        found = self._found_moments()
        return found["first"], found["second"]

    def definition(self, name: str) -> np.ndarray:
        """A quantity that terrain science defines, (rows, columns) float32.

        `name` is "svf-tilted" (A), "svf-horizontal", "svf-solid-angle", "openness-positive" or "openness-negative"
        (rad), "mean-cos-h", or "terrain-view-factor"; `definitions()` has the formulas. The walks are those for the
        error wanted of A. Raises ValueError for other names.
        """
        if name not in self._definitions:
            found = _native.definitions(self._surface, self._settings, [str(name)], *self._task)
            self._definitions[name] = found["definitions"][0]
        return self._definitions[name]

    def horizons(self, azimuths: Union[int, Sequence[float]], convention: str = "math") -> np.ndarray:
        """Elevations of the horizon, in radians: (azimuths, rows, columns) float32.

        They are never below the elevation of the tangent plane.

        Args:
            azimuths: a number N for the azimuths 2π k/N, k = 0 … N − 1; or the angles themselves, in radians.
            convention: how azimuths count: "math", from x toward y, or "north", clockwise from north, which is y.
        """
        angles = angles_of(azimuths)
        if one_of("convention", convention, ("math", "north")) == "north":
            angles = [np.pi / 2 - angle for angle in angles]
        if not angles or not np.all(np.isfinite(angles)):
            raise ValueError("azimuths: must be finite angles, at least one")
        return _native.horizons(self._surface, self._settings, angles, *self._task)["horizons"]

    @property
    def evidence(self) -> dict[str, Any]:
        """How A was computed, its error against exact walks, and what it cost."""
        found = self._moments if self._shares is None and self._moments is not None else self._found()
        return json.loads(found["evidence"])


def definitions() -> dict[str, str]:
    """The definitions of terrain science that `Sky.definition` can compute: a dict from name to formula.

    In the formulas, h is the elevation of the horizon above the horizontal through the texel; means are over azimuths.
    """
    return _native.sky_definitions()


def angles_of(azimuths: Any) -> list[float]:
    """The azimuths 2π k/N for a number N, or the given angles; in radians."""
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
    """The part of the sky that every texel sees. Each quantity of the result is computed when you ask for it.

    Args:
        height: (rows, columns) of numbers, world units, row 0 on top; NaN is missing. Or a `Heightmap`.
        texel: distance between samples, world units: one number or (x, y). None: that of a Heightmap; for an array,
            the columns then span a width of 1.
        boundary: "tile" or "open". None: that of a Heightmap; for an array, "tile".
        error: RMSE wanted of A; 0: exact slices, which are far slower.
        azimuths: number of azimuths of the walk, an even number. None: chosen for the error.
        rays: number of rays per texel. With it, rays (the reference method) replace horizon walks.
        max_distance: maximum distance up to which occluders count, world units. None: no limit.
        falloff: how occluders fade toward the maximum distance: "none", "linear", "sqrt" or "exponential".
        below_horizontal: what is seen below the horizontal in directions that miss the surface: "sky", or "ground",
            which does not shine, as terrain tools assume. With "ground", A of a plane tilted by S is (1 + cos S)/2.
        seed: seed of every random choice.
        threads: number of threads; results do not depend on it. None: as OMP_NUM_THREADS says, else one per processor
            that this process may use by its affinity and its control group's quota.
        memory: bytes that may be taken beyond what the process already holds. (The command's --memory also includes
            the program itself.) None: four fifths of what is free on the machine, of what the control group leaves,
            or of what RLIMIT_AS leaves, whichever is least.
        progress: True shows bars if tqdm is installed; or a function (name, done, total, ended).

    Returns:
        A `Sky`.

    Raises:
        ValueError: for arguments that make no sense.
        MemoryError: if the work does not fit in memory; raised before the memory is taken.

    Ambient occlusion: Jimenez, Wu, Pesce and Jarabo, "Practical Realtime Strategies for Accurate Indirect
    Occlusion" (2016), whose AO is A.
    """
    surface, _ = surface_of(height, texel, boundary)
    chosen = settings(error, azimuths, rays, seed, threads, memory, progress)
    below = one_of("below_horizontal", below_horizontal, ("sky", "ground"))
    return Sky(surface, chosen, *max_distance_of(max_distance, falloff), below)
