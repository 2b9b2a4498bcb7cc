"""The accessor of xarray."""

import numpy as np
import pytest

import heightlight as hl

xr = pytest.importorskip("xarray")


def terrain(y_down=True, step=10.0, units="m", size=24):
    heights = hl.synth("fbm", size, relief=60).height
    y = np.arange(size) * step
    return xr.DataArray(
        heights if y_down else heights[::-1],
        dims=("y", "x"),
        coords={"y": ("y", y[::-1] if y_down else y, {"units": units}), "x": ("x", 500 + np.arange(size) * step, {"units": units})},
        attrs={"source": "made", "units": "m"},
    )


def test_spacing_comes_from_the_coordinates_and_they_stay():
    array = terrain()
    found = array.heightlight.sky_view_factor(error=0.005)
    expected = hl.sky(array.values.astype(float), texel=10, boundary="open", error=0.005).sky_view_factor
    np.testing.assert_array_equal(found.values, expected)
    assert found.dims == array.dims and found.attrs["source"] == "made" and found.attrs["units"] == "1"
    xr.testing.assert_equal(found.coords.to_dataset(), array.coords.to_dataset())
    assert found.name == "sky_view_factor"


def test_rows_that_go_up_are_turned():
    down, up = terrain(True), terrain(False)
    found = up.heightlight.sky_view_factor(error=0.005)
    np.testing.assert_array_equal(found.values[::-1], down.heightlight.sky_view_factor(error=0.005).values)
    np.testing.assert_array_equal(
        up.heightlight.irradiance(0.6).values[::-1], down.heightlight.irradiance(0.6).values
    )
    azimuths = up.heightlight.horizons(4)
    assert azimuths.dims == ("azimuth", "y", "x") and azimuths.sizes["azimuth"] == 4
    np.testing.assert_array_equal(azimuths.values[:, ::-1], down.heightlight.horizons(4).values)


def test_degrees_are_refused_with_the_spacing_in_metres():
    array = terrain(step=1 / 3600, units="degrees_north")
    array["y"] = array["y"] + 47
    array["y"].attrs["units"] = "degrees_north"
    with pytest.raises(ValueError, match=r"degrees.*texel=\(21\.\d+, 30\.8\d*\)"):
        array.heightlight.sky_view_factor()
    assert array.heightlight.sky_view_factor(texel=(21.1, 30.9)).shape == array.shape


def test_a_crs_is_kept_and_told_from_its_text():
    pytest.importorskip("rioxarray")
    array = terrain().rio.write_crs("EPSG:2056")
    found = array.heightlight.sky_view_factor(error=0.01)
    assert found.rio.crs == array.rio.crs
    geographic = terrain(step=1 / 3600, units="").rio.write_crs("EPSG:4326")
    with pytest.raises(ValueError, match="degrees"):
        geographic.heightlight.sky_view_factor()


def test_no_data_is_missing():
    array = terrain()
    array.values[2, 3] = -9999
    array.attrs["_FillValue"] = -9999
    found = array.heightlight.ambient_occlusion(error=0.01)
    assert np.isnan(found.values[2, 3]) and np.isnan(found.values).sum() == 1


def test_coordinates_must_tell_a_spacing():
    array = terrain()
    with pytest.raises(ValueError, match="not evenly spaced"):
        array.assign_coords(x=np.arange(24) ** 2).heightlight.sky_view_factor()
    numbered = array.assign_coords(x=np.arange(24) + 0.5, y=np.arange(24) + 0.5)
    with pytest.raises(ValueError, match="count samples"):
        numbered.heightlight.sky_view_factor()
    with pytest.raises(ValueError, match="no coordinates"):
        array.drop_vars("x").heightlight.sky_view_factor()
    with pytest.raises(ValueError, match="two; choose a band"):
        array.expand_dims("band").heightlight.sky_view_factor()
    assert array.drop_vars(["x", "y"]).heightlight.sky_view_factor(texel=10, error=0.01).shape == array.shape


def test_light_of_ones_own_and_albedo_maps_are_turned_too():
    up = terrain(False)
    albedo = np.linspace(0, 0.9, up.size).reshape(up.shape)
    sun = np.random.default_rng(1).random(up.shape)
    found = up.heightlight.irradiance(albedo, direct=sun)
    op = hl.operator(up.values[::-1].astype(float), texel=10, boundary="open", direct=sun[::-1])
    np.testing.assert_array_equal(found.values[::-1], op.solve(albedo[::-1], sun[::-1]))


def test_suns_and_definitions_lie_as_the_array_does():
    down, up = terrain(True), terrain(False)
    for found in (
        lambda array: array.heightlight.sun_irradiance(160, 20),
        lambda array: array.heightlight.definition("svf-horizontal"),
        lambda array: array.heightlight.irradiance(0.9, direct=array.heightlight.sun_irradiance(160, 20)),
    ):
        np.testing.assert_array_equal(found(up).values[::-1], found(down).values)
    assert down.heightlight.definition("openness-positive").attrs["units"] == "rad"
    expected = hl.sun_irradiance(down.values.astype(float), 160, 20, texel=10, boundary="open")
    np.testing.assert_array_equal(down.heightlight.sun_irradiance(160, 20).values, expected)
