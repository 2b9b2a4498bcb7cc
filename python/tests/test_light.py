"""Light of one's own."""

import numpy as np
import pytest

import heightlight as hl


def test_a_level_plain_has_the_sine_of_the_elevation():
    plain = hl.Heightmap(np.zeros((6, 7)), 1, "open")
    np.testing.assert_allclose(hl.sun_irradiance(plain, 135, 30), 0.5, rtol=1e-6)


def test_the_sun_comes_from_where_the_compass_says():
    wall = np.zeros((41, 41))
    wall[20] = 5
    plain = hl.Heightmap(wall, 1, "open")
    shadow = hl.sun_irradiance(plain, 180, 45, diameter=0)[:, 20] < 0.1  # from the south: north of the wall
    assert shadow[16:19].all() and not shadow[:13].any() and not shadow[22:].any()


def test_sun_and_snow_are_what_the_command_bakes(command):
    heights = hl.synth("fbm", 48, relief=0.3)
    folder = command("synth", "fbm", "-o", "fbm.exr", "--size", 48)
    command(
        "bake", "fbm.exr", "-o", "o", "--maps", "direct,multibounce", "--sun", "100,40", "--albedo", 0.9,
        "--relief", 0.3, "--boundary", "open", "--format", "exr", "--quiet",
    )
    opened = hl.Heightmap(heights.height, heights.texel, "open")
    sun = hl.sun_irradiance(opened, 100, 40)
    total = hl.operator(opened, direct=sun).solve(0.9, direct=sun)
    for values, name in ((sun, "direct"), (total, "multibounce")):
        baked = hl.read(folder / f"o/fbm_{name}.exr")
        np.testing.assert_allclose(values, baked.height + baked.base, atol=2e-7)  # float32 above the lowest


def test_an_even_sky_sends_the_sky_view_factor(brick):
    sent = hl.sky_irradiance(brick, np.ones((4, 8, 3)), error=1e-3)
    assert np.sqrt(np.mean((sent - hl.sky(brick).sky_view_factor) ** 2)) < 2e-3


def test_colours_bounce_each_for_itself(brick, brick_operator):
    colours = hl.sky_irradiance(brick, np.random.default_rng(3).random((8, 16, 3)))
    assert colours.shape == (64, 64, 3)
    total = brick_operator.solve(0.5, direct=colours)
    np.testing.assert_array_equal(total[:, :, 1], brick_operator.solve(0.5, direct=colours[:, :, 1]))


@pytest.mark.parametrize("angles", [(0, -1), (0, 91), (float("nan"), 3)])
def test_suns_below_the_horizon_are_refused(brick, angles):
    with pytest.raises(ValueError):
        hl.sun_irradiance(brick, *angles)


def test_other_skies_are_refused(brick):
    with pytest.raises(ValueError, match="overcast"):
        hl.sky_irradiance(brick, "cloudy")
    with pytest.raises(ValueError, match="radiance"):
        hl.sky_irradiance(brick, np.ones((4, 8)))
