"""Irradiance of the bounces."""

from __future__ import annotations

import json
from typing import Any, Iterable, Optional, Sequence, Union

import numpy as np

from . import _native
from ._heights import HeightLike, numbers, surface_of
from ._settings import integer, settings

AlbedoLike = Union[float, Sequence[float], np.ndarray]


class Curves(dict):
    """Bounce curves: a dict of columns of equal length, with one row per kind of AO, filled bin and bounce.

    The columns are ao_kind ("ambient_occlusion", which is α, or "sky_view_factor", which is A); bin, ao_lo, ao_hi,
    ao_mean and count of the bin; bounce, where −1 is the tail, all later bounces together; and mean, stddev, p05, p50
    and p95 of E_b/π at albedo 1 over the bin's texels.

    Attributes:
        bins: number of bins, including the empty ones, which have no rows.
    """

    def __init__(self, tables: Iterable[dict[str, Any]]) -> None:
        parts = list(tables)
        columns = [name for name in parts[0] if isinstance(parts[0][name], np.ndarray)]
        kinds = [np.full(len(part["bin"]), part["kind"]) for part in parts]
        super().__init__(ao_kind=np.concatenate(kinds))
        for name in columns:
            self[name] = np.concatenate([part[name] for part in parts])
        self.bins: int = parts[0]["bins"]

    def over(self, kind: str) -> dict[str, Any]:
        """The rows of one kind of AO, as a dict that also has `kind` and `bins`."""
        rows = self["ao_kind"] == kind
        return {"kind": kind, "bins": self.bins, **{name: column[rows] for name, column in self.items() if name != "ao_kind"}}

    def bounce(self, number: int, kind: str = "ambient_occlusion") -> tuple[np.ndarray, np.ndarray]:
        """Mean AO and mean E_b/π at albedo 1 of each filled bin, as two arrays to plot."""
        rows = (self["bounce"] == number) & (self["ao_kind"] == kind)
        return self["ao_mean"][rows], self["mean"][rows]

    def to_pandas(self) -> Any:
        """The columns as a pandas.DataFrame. Raises ImportError without pandas."""
        import pandas

        return pandas.DataFrame(dict(self))


class Operator:
    """The operator F of one surface, which carries irradiance from one bounce to the next: E = direct + F ρ E.

    `op @ e` is F e. `operator()` makes it. Two threads may use one operator at the same time.

    Attributes:
        shape: (rows, columns).
    """

    def __init__(self, surface: Any, chosen: Any, direct: Any = None) -> None:
        self._surface = surface
        self._native = _native.Operator(surface, chosen, [] if direct is None else split_direct(direct))
        self.shape: tuple[int, int] = (surface.height, surface.width)
        self._evidence: Optional[str] = None

    @property
    def direct(self) -> np.ndarray:
        """E₀/π under an even sky, which is A, (rows, columns) float64. Together with F applied to ones, it gives 1."""
        return self._native.direct

    @property
    def sky_view_factor(self) -> np.ndarray:
        """The sky view factor A, (rows, columns) float32 in [0, 1]; 1 = open."""
        return self._native.sky_view_factor

    @property
    def ambient_occlusion(self) -> np.ndarray:
        """The uniform ambient occlusion α, (rows, columns) float32 in [0, 1]; 1 = open."""
        return self._native.ambient_occlusion

    @property
    def seen(self) -> np.ndarray:
        """n, the mean sky view factor of what each texel sees of the surface, (rows, columns) float32. From A and n,
        `forms.seen_stored` gives the total at any albedo."""
        return self._native.seen()

    @property
    def evidence(self) -> dict[str, Any]:
        """How the last `solve` or `bounces` was computed, and its error against exact walks. Empty before the first."""
        return json.loads(self._evidence) if self._evidence else {}

    def _gather(self, irradiance: np.ndarray) -> np.ndarray:
        gathered = self._native.gather(irradiance)
        gathered[np.isnan(self.direct)] = np.nan
        return gathered

    def __matmul__(self, irradiance: Any) -> np.ndarray:
        """F applied to irradiance (rows, columns), or to a stack (n, rows, columns); float64. NaN counts as 0."""
        values = numbers("irradiance", irradiance)
        if values.ndim == 3:
            return np.stack([self._gather(one) for one in values]) if len(values) else np.empty(values.shape)
        return self._gather(values)

    def bounces(self, count: int = 20) -> np.ndarray:
        """E_b/π of each bounce b = 0 … count at albedo 1: (count + 1, rows, columns) float64.

        At albedo ρ, multiply bounce b by ρ^b. All later bounces together bring 1 minus the sum of these.
        """
        bounces, _, self._evidence = self._native.bounces(integer("bounces", count, 1, 1000))
        return np.stack(bounces)

    def solve(self, albedo: AlbedoLike, direct: Optional[np.ndarray] = None) -> np.ndarray:
        """Finds E/π, the total irradiance of all bounces.

        Args:
            albedo: one number, three (red, green, blue), an array (rows, columns), or (rows, columns, 3); in [0, 1].
            direct: E₀/π of your own light, (rows, columns) or (rows, columns, 3), as `sun_irradiance` and
                `sky_irradiance` return it. None: E₀/π of an even sky.

        Returns:
            (rows, columns) float64, or (rows, columns, 3) for three channels. These are the values that `simulate`
            writes after conversion to float32.
        """
        constant, varying = split_albedo(albedo, self.shape)
        light = [] if direct is None else split_direct(direct)
        totals, self._evidence = self._native.solve(constant, varying, light)
        return totals[0] if len(totals) == 1 else np.stack(totals, axis=-1)

    def curves(self, bins: int = 100, bounces: int = 20) -> Curves:
        """Bounce curves over α and over A, as `simulate` writes them to curves.csv.

        `bins` is the number of bins, 1 to 10000; `bounces` is how many bounces are kept apart, 1 to 1000.
        """
        over_alpha, over_sky, _, _ = self._curves(bins, bounces)
        return Curves((over_alpha, over_sky))

    def _curves(self, bins: int, bounces: int) -> tuple[dict[str, Any], dict[str, Any], float, float]:
        return self._native.curves(integer("bins", bins, 1, 10000), integer("bounces", bounces, 1, 1000))

    def as_linear_operator(self, albedo: Optional[AlbedoLike] = None) -> Any:
        """F as a scipy.sparse.linalg.LinearOperator on vectors of rows × columns numbers, 0 where a sample is missing.

        With an albedo (one channel), it is I − F ρ instead; solving it for `op.direct` gives `op.solve(albedo)`.
        """
        from scipy.sparse.linalg import LinearOperator

        size = self.shape[0] * self.shape[1]
        if albedo is None:
            return LinearOperator((size, size), matvec=lambda x: self._native.gather(x.reshape(self.shape)).ravel())
        constant, varying = split_albedo(albedo, self.shape)
        if len(constant) + len(varying) != 1:
            raise ValueError("albedo: must have one channel")
        reflectance = np.nan_to_num(varying[0]).ravel() if varying else constant[0]
        return LinearOperator(
            (size, size),
            matvec=lambda x: x.ravel() - self._native.gather((reflectance * x.ravel()).reshape(self.shape)).ravel(),
        )


def split_direct(direct: Any) -> list[np.ndarray]:
    """A list of maps, one per channel."""
    values = numbers("direct", direct)
    if values.ndim == 3:
        return [np.ascontiguousarray(values[:, :, c]) for c in range(values.shape[2])]
    return [values]


def split_albedo(albedo: Any, shape: tuple[int, int]) -> tuple[list[float], list[np.ndarray]]:
    """One constant per channel, or one map per channel; the other list is empty."""
    values = numbers("albedo", albedo)
    if values.ndim == 0:
        return [float(values)], []
    if values.ndim == 1 and values.shape[0] in (1, 3):
        return [float(value) for value in values], []
    if values.ndim == 2:
        return [], [values]
    if values.ndim == 3 and values.shape[2] in (1, 3):
        return [], [np.ascontiguousarray(values[:, :, c]) for c in range(values.shape[2])]
    rows, columns = shape
    raise ValueError(f"albedo: must be one number, three, {rows} × {columns}, or {rows} × {columns} × 3")


def operator(
    height: HeightLike,
    *,
    texel: Any = None,
    boundary: Optional[str] = None,
    error: float = 2e-3,
    azimuths: Optional[int] = None,
    rays: Optional[int] = None,
    direct: Optional[np.ndarray] = None,
    seed: int = 1,
    threads: Optional[int] = None,
    memory: Optional[int] = None,
    progress: Any = False,
) -> Operator:
    """Makes the operator F of a surface, once for any number of solutions.

    With horizon walks no form factor is stored; with `rays`, or with error = 0, all of them are.

    Args:
        error: RMSE wanted of A, and of totals at albedos up to 0.8; 0: exact slices.
        direct: E₀/π of your own light, such as the sun's, whose totals are to have that error; walks are planned for
            it. None: they are planned for an even sky.

    The other arguments are those of `sky()`.
    """
    surface, _ = surface_of(height, texel, boundary)
    return Operator(surface, settings(error, azimuths, rays, seed, threads, memory, progress), direct)
