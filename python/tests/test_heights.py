"""Heights from arrays, files and shapes."""

import os
from pathlib import Path

import numpy as np
import pytest

import heightlight as hl


def mean_sky(heights, **options):
    return hl.sky(heights, **options).sky_view_factor


def test_every_kind_of_array_is_taken():
    whole = np.random.default_rng(2).integers(0, 100, (12, 9))
    expected = mean_sky(whole.astype(np.float64), texel=20)
    for dtype in ("f4", ">f4", "f8", ">f8", "i2", ">i2", "u1", "i8", "f2"):
        np.testing.assert_array_equal(mean_sky(whole.astype(dtype), texel=20), expected)
    np.testing.assert_array_equal(mean_sky(np.asfortranarray(whole), texel=20), expected)
    np.testing.assert_array_equal(mean_sky(np.repeat(whole, 2, axis=0)[::2], texel=20), expected)
    np.testing.assert_array_equal(mean_sky(whole.tolist(), texel=20), expected)
    np.testing.assert_array_equal(mean_sky(whole[::-1, ::-1], texel=20), mean_sky(whole[::-1, ::-1].copy(), texel=20))


def test_inputs_are_left_alone():
    heights = np.random.default_rng(3).random((8, 8)).astype(np.float32)
    before = heights.copy()
    heights.setflags(write=False)
    op = hl.operator(heights)
    light = np.ones((8, 8))
    light.setflags(write=False)
    op @ light
    op.solve(0.5, light)
    np.testing.assert_array_equal(heights, before)


def test_results_own_their_memory():
    found = hl.sky(np.zeros((6, 6))).sky_view_factor
    assert found.flags.writeable
    found[:] = 7  # the surface is gone by now
    assert found.sum() == 7 * 36


def test_heights_count_from_anywhere():
    heights = hl.synth("brick", 32).height.astype(np.float64)
    np.testing.assert_array_equal(mean_sky(heights + 2.0**20), mean_sky(heights + 2.0**20 - 2.0**19))


def test_spacing_matters():
    heights = hl.synth("brick", 32).height
    near, far = mean_sky(heights, texel=0.01).mean(), mean_sky(heights, texel=(1, 1)).mean()
    assert near < far
    np.testing.assert_array_equal(mean_sky(hl.Heightmap(heights, (1, 1))), mean_sky(heights, texel=1))
    with pytest.raises(ValueError, match="texel"):
        hl.sky(heights, texel=(1, 2, 3))
    for bad in (-1, 0, float("nan"), float("inf"), "wide"):
        with pytest.raises(ValueError):
            hl.sky(heights, texel=bad)


def test_shapes():
    assert set(hl.shapes()) >= {"brick", "bowl", "fbm"}
    cliff = hl.synth("cliff", 16, relief=2, width=4)
    assert cliff.boundary == "open" and cliff.texel == (0.25, 0.25) and cliff.height.max() == 2
    assert hl.synth("brick", 16).boundary == "tile"
    assert not np.array_equal(hl.synth("fbm", 16).height, hl.synth("fbm", 16, seed=2).height)
    with pytest.raises(ValueError, match="igloo"):
        hl.synth("igloo")


def test_files(tmp_path):
    image = pytest.importorskip("PIL.Image")
    levels = (hl.synth("brick", 32).height * 655350).astype(np.uint16)
    image.fromarray(levels).save(tmp_path / "brick.png")
    map = hl.read(tmp_path / "brick.png", width=2, relief=0.5)
    assert map.texel == (1 / 16, 1 / 16) and map.height.max() == 0.5 and map.boundary == "tile"
    assert map.facts["bits"] == 16 and len(map.facts["sha256"]) == 64
    assert hl.read(str(tmp_path / "brick.png"), texel=(1, 2), boundary="open").boundary == "open"
    with pytest.raises(OSError, match="absent.png: no such file"):
        hl.read(tmp_path / "absent.png")
    (tmp_path / "text.png").write_text("no picture")
    with pytest.raises(OSError, match="holds text"):
        hl.read(tmp_path / "text.png")
    with pytest.raises(ValueError, match="relief"):
        hl.read(tmp_path / "brick.png", relief=-1)
    with pytest.raises(ValueError, match="exclude|texel"):
        hl.read(tmp_path / "brick.png", texel=1, width=1)


def test_what_a_user_should_know_is_warned_of(tmp_path):
    image = pytest.importorskip("PIL.Image")
    image.fromarray((hl.synth("fbm", 64).height * 800).astype(np.uint8)).save(tmp_path / "steep.png")
    with pytest.warns(UserWarning, match="steep.png"):
        hl.read(tmp_path / "steep.png", relief=50)


def test_a_real_terrain():
    dem = Path(os.environ.get("HEIGHTLIGHT_SHARED_DIR", "")) / "data"
    grids = sorted(dem.rglob("*.asc")) if dem.is_dir() else []
    if not grids:
        pytest.skip("no real terrain is at hand: NOT TESTED")
    for grid in grids[:3]:
        try:
            map = hl.read(grid)
        except OSError as fault:
            assert "degrees" in str(fault)  # and says how many metres those are
            map = hl.read(grid, texel=90)
        assert map.boundary == "open" and min(map.shape) > 10


def test_arrays_and_raw_samples_of_files(tmp_path):
    heights = hl.synth("fbm", 24, relief=30).height[:16]
    np.save(tmp_path / "array.npy", heights)
    map = hl.read(tmp_path / "array.npy", texel=2)
    np.testing.assert_array_equal(map.height, (heights.astype(float) - heights.min()).astype(np.float32))
    levels = (np.arange(12) * 100).reshape(3, 4).astype(">u2")
    levels.tofile(tmp_path / "levels.r16")
    map = hl.read(tmp_path / "levels.r16", size=(3, 4), big_endian=True, scale=0.5, offset=-10, texel=1)
    np.testing.assert_array_equal(map.height + map.base, levels * 0.5 - 10)
    with pytest.raises(OSError, match="holds raw samples"):
        hl.read(tmp_path / "levels.r16")
    with pytest.raises(ValueError, match="scale"):
        hl.read(tmp_path / "levels.r16", size=(3, 4), scale=2, relief=1)
