"""Direct irradiance of the sun and of uneven skies."""

from __future__ import annotations

from typing import Any, Optional, Union

import numpy as np

from . import _native
from ._heights import HeightLike, surface_of
from ._settings import real, settings


def sun_irradiance(
    height: HeightLike,
    azimuth: float,
    elevation: float,
    *,
    diameter: float = 0.533,
    texel: Any = None,
    boundary: Optional[str] = None,
    threads: Optional[int] = None,
    progress: Any = False,
) -> np.ndarray:
    """Finds the direct irradiance E₀/π of the sun alone, with exact horizons.

    `Operator.solve(albedo, direct=…)` finds the total with its bounces.

    Args:
        height: heights, as for `sky()`.
        azimuth: azimuth of the sun's centre, in degrees clockwise from north, which is the array's top.
        elevation: elevation of the sun's centre above the horizontal, in degrees, 0 to 90.
        diameter: diameter of the sun's disc, in degrees; 0: a point.

    The other arguments are those of `sky()`.

    Returns:
        (rows, columns) float64, in units in which a plane that faces the sun has 1; a level open plain has
        sin(elevation).
    """
    surface, _ = surface_of(height, texel, boundary)
    chosen = settings(2e-3, None, None, 1, threads, None, progress)
    angles = [real(name, value) for name, value in (("azimuth", azimuth), ("elevation", elevation), ("diameter", diameter))]
    return _native.sun_irradiance(surface, chosen, *angles)


def sky_irradiance(
    height: HeightLike,
    sky: Union[str, np.ndarray] = "overcast",
    *,
    error: float = 2e-3,
    azimuths: Optional[int] = None,
    texel: Any = None,
    boundary: Optional[str] = None,
    seed: int = 1,
    threads: Optional[int] = None,
    progress: Any = False,
) -> np.ndarray:
    """Finds the direct irradiance E₀/π of a sky.

    Args:
        height: heights, as for `sky()`.
        sky: "overcast", the CIE's overcast sky, under which a level open plain has 1; or radiance by latitude and
            longitude, (n, 2 n, 3), as `read_sky` returns it, with rows from the zenith down and the array's top
            (north) in the middle.
        error: RMSE wanted. The number of azimuths is doubled until a check by exact horizons finds that error, up to
            512.

    The other arguments are those of `sky()`.

    Returns:
        (rows, columns) float64, or (rows, columns, 3) if the sky has colours.
    """
    surface, _ = surface_of(height, texel, boundary)
    chosen = settings(error, azimuths, None, seed, threads, None, progress)
    if isinstance(sky, str) and sky != "overcast":
        raise ValueError(f"sky {sky}: must be overcast, or radiance: (rows, 2 rows, 3)")
    radiance = None if isinstance(sky, str) else np.asarray(sky, dtype=np.float32)
    channels, _, _ = _native.sky_irradiance(surface, chosen, radiance)
    return channels[0] if len(channels) == 1 else np.stack(channels, axis=-1)
