"""The accessor `DataArray.heightlight`, which exists if xarray is installed."""

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
    """Visibility and irradiance on a terrain in a DataArray `da`, as `da.heightlight`.

    The spacing comes from the coordinates. Results keep the coordinates, the attributes and the CRS.

    The array has two dimensions, rows (y) and columns (x), whose coordinates are in metres and evenly spaced.
    Coordinates in degrees are refused: reproject first, or give `texel` in metres. The boundary is "open" unless you
    say otherwise. Samples equal to the declared no-data value are missing.
    """

    def __init__(self, array: xr.DataArray) -> None:
        self._array = array

    def heightmap(self, texel: Any = None, boundary: str = "open") -> Heightmap:
        """The heights with their spacing, as a `Heightmap` with row 0 on top whether y rises or falls."""
        array = self._array
        self._check_dimensions()
        heights = np.array(array.values, dtype=np.float64)
        missing = self._missing()
        if missing is not None:
            heights[heights == missing] = np.nan
        x, y = self._steps(texel)
        if y > 0:  # the rows run upwards
            heights = heights[::-1]
        if x < 0:
            heights = heights[:, ::-1]
        spacing = (abs(x), abs(y)) if texel is None else texel
        return Heightmap(heights, spacing, boundary)

    def sky_view_factor(self, *, texel: Any = None, boundary: str = "open", **options: Any) -> xr.DataArray:
        """The sky view factor A, 1 = open. `options` are those of `heightlight.sky`."""
        found = sky(self.heightmap(texel, boundary), **options)
        return self._like(found.sky_view_factor, "sky_view_factor", "sky view factor", texel)

    def ambient_occlusion(self, *, texel: Any = None, boundary: str = "open", **options: Any) -> xr.DataArray:
        """The ambient occlusion α, the fraction of the hemisphere's solid angle that sees the sky; 1 = open. `options` are
        those of `heightlight.sky`."""
        found = sky(self.heightmap(texel, boundary), **options)
        return self._like(found.ambient_occlusion, "ambient_occlusion", "share of the hemisphere that sees the sky", texel)

    def horizons(self, azimuths: Any, *, texel: Any = None, boundary: str = "open", **options: Any) -> xr.DataArray:
        """Elevations of the horizon, in radians, with a first dimension `azimuth`, in radians from x toward y.

        `azimuths` are as in `Sky.horizons`; `options` are those of `heightlight.sky`.
        """
        angles = angles_of(azimuths)
        found = sky(self.heightmap(texel, boundary), **options).horizons(angles)
        maps = [self._like(one, "horizon", "elevation of the horizon", texel, "rad") for one in found]
        return xr.concat(maps, xr.Variable("azimuth", angles, {"units": "rad"}))

    def definition(self, name: str, *, texel: Any = None, boundary: str = "open", **options: Any) -> xr.DataArray:
        """A quantity that terrain science defines: "svf-horizontal", "openness-positive" …

        `heightlight.definitions()` lists the names. `options` are those of `heightlight.sky`.
        """
        found = sky(self.heightmap(texel, boundary), **options).definition(name)
        return self._like(found, name.replace("-", "_"), definitions()[name], texel, "rad" if name.startswith("open") else "1")

    def sun_irradiance(
        self, azimuth: float, elevation: float, *, texel: Any = None, boundary: str = "open", **options: Any
    ) -> xr.DataArray:
        """The direct irradiance E₀/π of the sun alone, in units in which a plane that faces the sun has 1.

        Angles are in degrees, the azimuth clockwise from north. `irradiance(albedo, direct=…)` finds the total with
        the bounces. `options` are those of `heightlight.sun_irradiance`.
        """
        found = sun_irradiance(self.heightmap(texel, boundary), azimuth, elevation, **options)
        return self._like(found, "sun_irradiance", "direct irradiance of the sun over that of a plane that faces it", texel)

    def irradiance(
        self, albedo: Any = 0.2, *, direct: Optional[Any] = None, texel: Any = None, boundary: str = "open", **options: Any
    ) -> xr.DataArray:
        """The total irradiance E/π of all bounces; a level open plane under a sky of radiance 1 has 1.

        `albedo` is a number, or an array of the map's shape. `direct` is E₀/π of your own light, of the map's shape;
        None: that of an even sky. `options` are those of `heightlight.operator`.
        """
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
        """The value that stands for a missing sample; None if the array declares none."""
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
        """Whether the coordinates merely count samples, as those that rioxarray gives to a file without a georeference."""
        numbered = all(np.array_equal(values, np.arange(values.size) + 0.5) for values in (x, y))
        return numbered and not self._crs() and not any(self._units())

    def _steps(self, texel: Any) -> tuple[float, float]:
        """The steps along x and y; their signs say in which direction the axes run."""
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
        """The array's attributes, as far as they are true of a result, with the result's meaning and units."""
        kept = {key: value for key, value in self._array.attrs.items() if key not in _STORED_AS}
        return {**kept, "long_name": meaning, "units": units}
