"""What texels see of the sky."""

import numpy as np
import pytest

import heightlight as hl


def test_a_plane_is_open():
    sky = hl.sky(np.zeros((8, 12)), boundary="open")
    np.testing.assert_array_equal(sky.sky_view_factor, 1)
    np.testing.assert_array_equal(sky.ambient_occlusion, 1)
    np.testing.assert_allclose(sky.bent_normal, np.broadcast_to([0, 0, 1], (8, 12, 3)), atol=1e-6)


def test_a_spherical_cap_sees_all_of_itself_alike():
    size, depth = 256, 0.3
    x, y = np.meshgrid((np.arange(size) + 0.5) / size - 0.5, (np.arange(size) + 0.5) / size - 0.5)
    rim = 0.45
    radius = (rim**2 + depth**2) / (2 * depth)
    inside = np.hypot(x, y) < rim
    heights = np.where(inside, radius - depth - np.sqrt(np.maximum(radius**2 - x**2 - y**2, 0)), 0)
    found = hl.sky(heights, boundary="open").sky_view_factor
    deep = np.hypot(x, y) < 0.6 * rim
    # A sphere's form factor to any part of itself is that part's share of its area.
    expected = 1 - 2 * np.pi * radius * depth / (4 * np.pi * radius**2)
    np.testing.assert_allclose(found[deep], expected, atol=0.01)  # discretisation


def test_missing_samples_are_nan(holed):
    sky = hl.sky(holed)
    for values in (sky.sky_view_factor, sky.ambient_occlusion, sky.bent_normal[:, :, 0], sky.horizons(2)[1]):
        np.testing.assert_array_equal(np.isnan(values), np.isnan(holed.height))
    masked = np.ma.masked_invalid(holed.height)
    np.testing.assert_array_equal(
        hl.sky(masked, texel=holed.texel, boundary="open").sky_view_factor, sky.sky_view_factor
    )


def test_only_what_is_asked_for_is_found(brick):
    sky = hl.sky(brick)
    assert sky._shares is None and sky._moments is None
    sky.bent_normal
    assert sky._shares is None
    sky.sky_view_factor
    assert sky._shares is not None


def test_moments_and_horizons_have_their_shapes(brick):
    sky = hl.sky(brick, error=0.01)
    first, second = sky.moments
    assert first.shape == (*brick.shape, 3) and second.shape == (*brick.shape, 5)
    assert sky.horizons(6).shape == (6, *brick.shape)
    assert sky.horizons([0.5]).shape == (1, *brick.shape)
    assert sky.horizons(1).min() > -np.pi / 2


def test_horizons_count_from_x_toward_y():
    # A wall on the map's right, which its x axis looks at; one on top, which y looks at.
    heights = np.zeros((33, 33))
    heights[:, -1] = 1
    right = hl.sky(heights, texel=0.1, boundary="open").horizons(4)[:, 16, 16]
    assert right[0] > 0.3 and right[2] < 0.01
    top = hl.sky(np.rot90(heights), texel=0.1, boundary="open").horizons(4)[:, 16, 16]
    assert top[1] > 0.3 and top[3] < 0.01


def test_ways_of_looking_agree(brick):
    walks = hl.sky(brick, error=5e-4).sky_view_factor
    rays = hl.sky(brick, rays=4096).sky_view_factor
    slices = hl.sky(brick, error=0, azimuths=256).sky_view_factor
    assert np.sqrt(np.mean((walks - slices) ** 2)) < 1.5e-3
    assert np.sqrt(np.mean((rays - slices) ** 2)) < 1e-2


def test_evidence_tells_the_error(brick):
    evidence = hl.sky(brick).evidence
    assert 0 < evidence["visibility"]["rmse_estimate"] < 2e-3
    assert evidence["seconds"]


@pytest.mark.parametrize("threads", [1, 3])
def test_threads_change_nothing(brick, threads):
    np.testing.assert_array_equal(hl.sky(brick, threads=threads).sky_view_factor, hl.sky(brick).sky_view_factor)


def test_a_reach_opens_the_sky(brick):
    near = hl.sky(brick, max_distance=0.01, falloff="linear").sky_view_factor
    assert near.mean() > hl.sky(brick).sky_view_factor.mean() + 0.05
