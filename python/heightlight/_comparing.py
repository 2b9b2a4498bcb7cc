"""Methods for AO and bounces beside light transport."""

from __future__ import annotations

from typing import Any, Iterable, Optional

import numpy as np

from . import _native
from ._heights import HeightLike, numbers, surface_of
from ._settings import integer, real, settings


class Comparison:
    """What `compare()` returns.

    Attributes:
        answer: a dict per AO, form and albedo: what the form errs by on exact AO, on GTAO's and on walks'.
        rows: a dict per method, parameters, variant (a form's name) and quantity: rmse, bias, p99, max, seconds.
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
    """Closed forms, rays, walks and screen-space methods beside light transport on one surface, as `heightlight
    compare` does: what each errs by, and what it costs.

    `forms`: of one's own, "NAME = FORMULA", fitted to the map. `sky`: radiance (rows, 2 rows, 3), whose direct
    light is compared (`read_sky`). `azimuths`: of the reference.
    """
    surface, _ = surface_of(height, texel, boundary)
    albedos = [real("albedo", value) for value in np.atleast_1d(numbers("albedo", albedo))]
    own = [forms] if isinstance(forms, str) else [str(form) for form in forms]
    light = None if sky is None else numbers("sky", sky).astype(np.float32)
    chosen = settings(seed=seed, threads=threads, memory=memory, progress=progress)
    rows, answer = _native.compare(surface, chosen, albedos, own, light, integer("azimuths", azimuths, 2, 65536))
    return Comparison(rows, answer)
