"""What terrain science asks for: definitions, the compass, the Earth's curvature."""

import numpy as np
import pytest

import heightlight as hl


def plane(tilt, size=25):
    x, _ = np.meshgrid(np.arange(size), np.arange(size))
    return np.tan(tilt) * x / size


def test_ground_below_the_horizontal_darkens_slopes():
    tilt = 0.7
    for options in ({}, {"error": 0, "azimuths": 128}, {"rays": 8192}):
        sky = hl.sky(plane(tilt), boundary="open", below_horizontal="ground", **options)
        np.testing.assert_allclose(sky.sky_view_factor, (1 + np.cos(tilt)) / 2, atol=6e-3)  # discretisation, Monte Carlo
    np.testing.assert_allclose(hl.sky(plane(tilt), boundary="open").sky_view_factor, 1, atol=1e-4)


def test_definitions_on_a_plane():
    tilt = 0.7
    sky = hl.sky(plane(tilt), boundary="open", below_horizontal="ground")
    expected = {
        "svf-tilted": (1 + np.cos(tilt)) / 2,
        "svf-horizontal": (1 + np.cos(tilt)) / 2,
        "svf-solid-angle": 1 - tilt / np.pi,
        "openness-positive": np.pi / 2,
        "openness-negative": np.pi / 2,
        "terrain-view-factor": (1 - np.cos(tilt)) / 2,
    }
    assert set(expected) | {"mean-cos-h"} == set(hl.definitions())
    for name, value in expected.items():
        assert sky.definition(name)[12, 12] == pytest.approx(value, abs=2e-3), name  # discretisation
        assert sky.definition(name) is sky.definition(name)
    with pytest.raises(ValueError, match="svf"):
        sky.definition("svf")


def test_horizons_by_the_compass():
    heights = np.zeros((33, 33))
    heights[:, -1] = 1  # a wall in the east
    sky = hl.sky(heights, texel=0.1, boundary="open")
    north = sky.horizons(4, convention="north")[:, 16, 16]
    assert north[1] > 0.3 and north[3] < 0.01
    np.testing.assert_allclose(north, sky.horizons([np.pi / 2, 0, -np.pi / 2, np.pi])[:, 16, 16], atol=1e-6)
    with pytest.raises(ValueError, match="convention"):
        sky.horizons(4, convention="compass")
    baked = hl.bake(hl.Heightmap(heights, 0.1, "open"), ["horizon"])
    np.testing.assert_allclose(baked["horizon"][16, 16], north, atol=1e-6)
    turned = hl.bake(hl.Heightmap(heights, 0.1, "open"), ["horizon"], azimuth_convention="math")
    assert turned["horizon"][16, 16, 0] == pytest.approx(north[1], abs=1e-6)


def test_definitions_are_baked(brick):
    baked = hl.bake(brick, ["svf-horizontal", "openness-negative"])
    np.testing.assert_array_equal(baked["svf-horizontal"], hl.sky(brick, error=2e-3).definition("svf-horizontal"))
    assert 1 < baked["openness-negative"].mean() < np.pi


def test_the_earth_hides_what_is_far():
    heights = np.zeros((5, 1001))
    heights[2, 800] = 2500
    sea = hl.Heightmap(heights, 100, "open", curvature=0.13)
    exact = {"error": 0, "azimuths": 4}
    found = hl.sky(sea, **exact).horizons(1)[0, 2]
    kappa = (1 - 0.13) / (2 * 6371008.8)
    for column in (0, 100, 500):
        way = 100 * (800 - column)
        assert found[column] == pytest.approx(np.arctan((2500 - kappa * way**2) / way), abs=1e-6)  # identity: floats
    with pytest.raises(ValueError, match="curvature"):
        hl.sky(hl.Heightmap(heights, 100, "tile", curvature=0.13)).sky_view_factor
    with pytest.raises(ValueError, match="curvature"):
        hl.sky(hl.Heightmap(heights, 100, "open", curvature=2)).sky_view_factor


def test_a_file_is_read_with_curvature(tmp_path):
    path = tmp_path / "sea.npy"
    np.save(path, np.zeros((9, 9), np.float32) + np.eye(9, dtype=np.float32))
    assert hl.read(path, texel=1000, boundary="open", curvature=0.13).curvature == 0.13
