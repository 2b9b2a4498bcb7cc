"""The accessor `DataArray.heightlight`, where xarray is installed."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
import xarray as xr

from . import _native
from ._heights import Heightmap
from ._light import sun_irradiance
from ._operator import operator
from ._sky import angles_of, definitions, sky

_DEGREES = ("degree", "degrees", "degrees_north", "degrees_east", "degree_north", "degree_east", "deg")

_STORED_AS = ("_FillValue", "scale_factor", "add_offset")


@xr.register_dataarray_accessor("heightlight")
class HeightlightAccessor:
    """Light on a terrain, `da.heightlight`: spacing from its coordinates, which results keep with its attributes
    and its CRS.

    The last two dimensions are rows (y) and columns (x), in metres, evenly spaced. Coordinates in degrees are
    refused: reproject first, or give `texel` in metres. The boundary is "open" unless said otherwise. Samples
    equal to the declared no-data are missing.
    """

    def __init__(self, array: xr.DataArray) -> None:
        self._array = array

    def heightmap(self, texel: Any = None, boundary: str = "open") -> Heightmap:
        """The heights, row 0 on top whichever way y runs, with their spacing."""
        array = self._array
        self._check_dimensions()
        heights = np.array(array.values, dtype=np.float64)
        missing = self._missing()
        if missing is not None:
            heights[heights == missing] = np.nan
        x, y = self._steps(texel)
        if y > 0:  # rows go up
            heights = heights[::-1]
        if x < 0:
            heights = heights[:, ::-1]
        spacing = (abs(x), abs(y)) if texel is None else texel
        return Heightmap(heights, spacing, boundary)

    def sky_view_factor(self, *, texel: Any = None, boundary: str = "open", **options: Any) -> xr.DataArray:
        """A, 1 = open. Options as those of `heightlight.sky`."""
        found = sky(self.heightmap(texel, boundary), **options)
        return self._like(found.sky_view_factor, "sky_view_factor", "sky view factor", texel)

    def ambient_occlusion(self, *, texel: Any = None, boundary: str = "open", **options: Any) -> xr.DataArray:
        """α, the plain share of the hemisphere, 1 = open."""
        found = sky(self.heightmap(texel, boundary), **options)
        return self._like(found.ambient_occlusion, "ambient_occlusion", "share of the hemisphere that sees the sky", texel)

    def horizons(self, azimuths: Any, *, texel: Any = None, boundary: str = "open", **options: Any) -> xr.DataArray:
        """Elevations of the horizon, rad, with the dimension `azimuth`, rad, counted from x toward y."""
        angles = angles_of(azimuths)
        found = sky(self.heightmap(texel, boundary), **options).horizons(angles)
        maps = [self._like(one, "horizon", "elevation of the horizon", texel, "rad") for one in found]
        return xr.concat(maps, xr.Variable("azimuth", angles, {"units": "rad"}))

    def definition(self, name: str, *, texel: Any = None, boundary: str = "open", **options: Any) -> xr.DataArray:
        """What terrain science calls by that name: "svf-horizontal", "openness-positive" … (`heightlight.definitions()`)."""
        found = sky(self.heightmap(texel, boundary), **options).definition(name)
        return self._like(found, name.replace("-", "_"), definitions()[name], texel, "rad" if name.startswith("open") else "1")

    def sun_irradiance(
        self, azimuth: float, elevation: float, *, texel: Any = None, boundary: str = "open", **options: Any
    ) -> xr.DataArray:
        """E₀/π of the sun alone, 1 where a plane faces it; angles in degrees, azimuths clockwise from north. Its bounces:
        `irradiance(albedo, direct=…)`."""
        found = sun_irradiance(self.heightmap(texel, boundary), azimuth, elevation, **options)
        return self._like(found, "sun_irradiance", "direct irradiance of the sun over that of a plane that faces it", texel)

    def irradiance(
        self, albedo: Any = 0.2, *, direct: Optional[Any] = None, texel: Any = None, boundary: str = "open", **options: Any
    ) -> xr.DataArray:
        """E/π of all bounces, 1 = a level open plane under a sky of radiance 1. `albedo`: a number, or an array of
        the map's shape. `direct`: E₀/π of light of one's own."""
        light = None if direct is None else self._turn(np.asarray(direct), texel)
        op = operator(self.heightmap(texel, boundary), direct=light, **options)
        reflectance = albedo if np.ndim(albedo) == 0 else self._turn(np.asarray(albedo), texel)
        total = op.solve(reflectance, light)
        return self._like(total, "irradiance", "irradiance of all bounces over that of an open plane", texel)

    def _check_dimensions(self) -> None:
        dims = self._array.dims
        if len(dims) != 2:
            raise ValueError(f"height: has the dimensions {', '.join(map(str, dims))}, and must have two; choose a band")

    def _missing(self) -> Any:
        """What stands for a missing sample, where the array declares it."""
        return self._array.attrs.get("_FillValue", self._array.encoding.get("_FillValue"))

    def _coordinates(self, axis: int) -> np.ndarray:
        name = self._array.dims[axis]
        if name not in self._array.coords:
            raise ValueError(f"the dimension {name} has no coordinates to take the spacing from; give texel")
        values = np.asarray(self._array.coords[name].values, dtype=np.float64)
        if values.size < 2:
            raise ValueError(f"the dimension {name} has one sample, and no spacing; give texel")
        steps = np.diff(values)
        if not np.allclose(steps, steps.mean(), rtol=1e-3, atol=0):
            raise ValueError(f"the coordinates {name} are not evenly spaced; resample, or give texel")
        return values

    def _crs(self) -> str:
        grid = self._array.coords.get("spatial_ref")
        return "" if grid is None else str(grid.attrs.get("crs_wkt", ""))

    def _units(self) -> list[str]:
        coords = [self._array.coords[dim] for dim in self._array.dims if dim in self._array.coords]
        return [str(coordinate.attrs.get("units", "")).lower() for coordinate in coords]

    def _in_degrees(self) -> bool:
        in_crs = self._crs().startswith(("GEOGCS", "GEOGCRS", "GEODCRS"))
        return in_crs or any(units in _DEGREES for units in self._units())

    def _counts_samples(self, x: np.ndarray, y: np.ndarray) -> bool:
        """As rioxarray numbers the pixels of a file that has no place on earth."""
        numbered = all(np.array_equal(values, np.arange(values.size) + 0.5) for values in (x, y))
        return numbered and not self._crs() and not any(self._units())

    def _steps(self, texel: Any) -> tuple[float, float]:
        """Along x and y; with their signs, which say which way the axes run."""
        if texel is not None:
            signs = []
            for axis in (1, 0):
                values = self._array.coords.get(self._array.dims[axis])
                rising = values is None or values.size < 2 or float(values[1]) > float(values[0])
                signs.append(1.0 if rising else -1.0)
            if self._array.dims[0] not in self._array.coords:
                signs[1] = -1.0
            return signs[0], signs[1]
        x, y = self._coordinates(1), self._coordinates(0)
        if self._counts_samples(x, y):
            raise ValueError("the coordinates count samples, and are no lengths; give texel, in metres")
        step_x, step_y = float(np.diff(x).mean()), float(np.diff(y).mean())
        if self._in_degrees():
            metres = _native.metres_of_degrees(abs(step_x), abs(step_y), float(y.mean()))
            raise ValueError(
                "the coordinates are in degrees, which are no lengths; reproject to metres, or give "
                f"texel=({metres[0]:.6g}, {metres[1]:.6g}), in metres at the middle of the map"
            )
        return step_x, step_y

    def _turn(self, values: np.ndarray, texel: Any) -> np.ndarray:
        x, y = self._steps(texel)
        return values[:: -1 if y > 0 else 1, :: -1 if x < 0 else 1]

    def _like(self, values: np.ndarray, name: str, meaning: str, texel: Any, units: str = "1") -> xr.DataArray:
        result = self._array.copy(data=self._turn(values, texel))
        result.name = name
        result.attrs = self._attributes(meaning, units)
        for key in _STORED_AS:
            result.encoding.pop(key, None)
        return result

    def _attributes(self, meaning: str, units: str) -> dict[str, Any]:
        """The array's own, as far as they are true of a result."""
        kept = {key: value for key, value in self._array.attrs.items() if key not in _STORED_AS}
        return {**kept, "long_name": meaning, "units": units}
