"""Compares methods for AO and bounces with light transport."""

from __future__ import annotations

from typing import Any, Iterable, Optional

import numpy as np

from . import _native
from ._heights import HeightLike, numbers, surface_of
from ._settings import integer, real, settings


class Comparison:
    """What `compare()` returns.

    Attributes:
        answer: a list with a dict per AO, form and albedo: the form's error on exact AO, on AO from GTAO and on AO
            from horizon walks.
        rows: a list with a dict per method, parameters, variant (the form's name) and quantity. Each has rmse,
            bias, p99, max and seconds.
    """

    def __init__(self, rows: list[dict[str, Any]], answer: list[dict[str, Any]]) -> None:
        self.rows = rows
        self.answer = answer

    def to_pandas(self) -> Any:
        """The rows as a pandas.DataFrame."""
        import pandas

        return pandas.DataFrame(self.rows)

    def __repr__(self) -> str:
        return f"<heightlight.Comparison of {len(self.rows)} rows>"


def compare(
    height: HeightLike,
    *,
    texel: Any = None,
    boundary: Optional[str] = None,
    albedo: Any = (0.2, 0.5, 0.8),
    forms: Iterable[str] = (),
    sky: Optional[np.ndarray] = None,
    azimuths: int = 128,
    seed: int = 1,
    threads: Optional[int] = None,
    memory: Optional[int] = None,
    progress: Any = False,
) -> Comparison:
    """Compares closed forms, rays, horizon walks and screen-space methods with light transport on one surface.

    Finds the error and the cost of each method, as `heightlight compare` does.

    Args:
        height: heights, as for `sky()`.
        albedo: one number or several, at which total irradiance is compared.
        forms: your own closed forms, "NAME = FORMULA"; their constants are fitted to the map.
        sky: radiance of a sky, (rows, 2 rows, 3), as `read_sky` returns it; its direct irradiance is then compared
            too.
        azimuths: number of azimuths of the reference, 2 to 65536.

    The other arguments are those of `sky()`.

    Returns:
        A `Comparison`.
    """
    surface, _ = surface_of(height, texel, boundary)
    albedos = [real("albedo", value) for value in np.atleast_1d(numbers("albedo", albedo))]
    own = [forms] if isinstance(forms, str) else [str(form) for form in forms]
    light = None if sky is None else numbers("sky", sky).astype(np.float32)
    chosen = settings(seed=seed, threads=threads, memory=memory, progress=progress)
    rows, answer = _native.compare(surface, chosen, albedos, own, light, integer("azimuths", azimuths, 2, 65536))
    return Comparison(rows, answer)
