"""heightlight.dask: on a cluster of two processes, what one process finds."""

import json
import os
import signal
import subprocess
import sys
import uuid
import warnings
from pathlib import Path

import numpy as np
import pytest

import heightlight as hl

try:
    import distributed
    import xarray as xr
except ImportError as missing:
    warnings.warn(f"NOT TESTED: heightlight.dask, for want of {missing.name} (scripts/install-packages --tests)")
    pytest.skip(f"{missing.name} is not installed: heightlight.dask is NOT TESTED", allow_module_level=True)

MAPS = ("ao", "multibounce", "bent-normal")


@pytest.fixture(scope="module")
def client():
    with distributed.LocalCluster(n_workers=2, processes=True, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            yield client


@pytest.fixture(autouse=True)
def in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.fixture(scope="module")
def relief():
    return hl.synth("fbm", 512, relief=60, width=2560).height


def saved(name, heights):
    np.save(name, heights)
    return name


def hills(heights, chunks=None, rising=False):
    """On a large offset, with a hole, as xarray has them; y falls, unless it is to rise."""
    heights = heights.astype(np.float64) + 4000
    heights[100:103, 200:230] = np.nan
    y = np.arange(512) * 5.0
    array = xr.DataArray(
        heights[::-1] if rising else heights,
        dims=("y", "x"),
        coords={"y": y if rising else y[::-1], "x": 7 + np.arange(512) * 5.0},
        attrs={"source": "made", "_FillValue": -9999.0},
        name="hills",
    )
    array[40, 50] = -9999
    return array if chunks is None else array.chunk(chunks)


def assert_same(found, expected):
    assert set(found.data_vars) == set(expected)
    for name, values in expected.items():
        np.testing.assert_array_equal(found[name].values, values)


@pytest.mark.parametrize("shape, window", [("brick", 128), ("fbm", 192)])
def test_a_file_gives_what_memory_and_one_process_give(client, shape, window, command):
    source = saved(f"{shape}.npy", hl.synth(shape, 512).height)
    found = hl.dask.bake(source, client, maps=MAPS, window=window, albedo=(0.1, 0.3, 0.5), error=0.01)
    expected = hl.bake(hl.read(source), MAPS, albedo=(0.1, 0.3, 0.5), error=0.01)
    assert_same(found, expected)
    assert found["ao"].data.chunksize == (window, window) and found["bent-normal"].shape == (512, 512, 3)
    told, wanted = json.loads(found.attrs["evidence"])["visibility"], expected.evidence["visibility"]
    assert [told[key] for key in ("azimuths", "full_share", "fineness")] == [wanted[key] for key in ("azimuths", "full_share", "fineness")]
    assert told["checked"]["total_rmse"] <= 0.01

    files = hl.dask.bake(source, client, maps=MAPS, window=window, output="ours", format="exr", depth="float", error=0.01)
    folder = command("bake", source, "-o", "theirs", "--out-of-core", 256, "--maps", ",".join(MAPS), "--format", "exr", "--error", 0.01, "--quiet")
    assert [file.name for file in files] == [f"{shape}_{name}.exr" for name in MAPS] + [f"{shape}_bake.json"]
    for file in files[:-1]:
        assert file.read_bytes() == (folder / "theirs" / file.name).read_bytes()
    assert sorted(os.listdir("ours")) == sorted(file.name for file in files)  # the work folder is gone


def test_a_total_that_misses_its_error_is_found_once_more(client):
    source = saved("steps.npy", hl.synth("steps", 256, relief=1).height)
    found = hl.dask.bake(source, client, maps=["ao", "multibounce"], window=128, albedo=0.8, error=0.004)
    expected = hl.bake(hl.read(source), ["ao", "multibounce"], albedo=0.8, error=0.004)
    assert expected.evidence["visibility"]["refined"]
    assert json.loads(found.attrs["evidence"])["visibility"]["refined"]
    assert_same(found, expected)


def test_a_worker_that_is_killed_half_way_changes_nothing(client, relief):
    source = saved("fbm.npy", relief)
    killed = []

    def kill(step, done, total, ended):
        if step == "sky" and done == total // 2 and not killed:
            killed.append(next(iter(client.run(os.getpid).values())))
            os.kill(killed[0], signal.SIGKILL)

    found = hl.dask.bake(source, client, maps=MAPS, window=128, texel=5, error=0.005, progress=kill)
    assert killed
    assert_same(found, hl.bake(hl.read(source, texel=5), MAPS, error=0.005))
    client.wait_for_workers(2, timeout=60)  # Dask's nanny begins another
    assert killed[0] not in client.run(os.getpid).values()


@pytest.mark.parametrize("rising", [False, True])
def test_an_array_of_chunks_gives_one(client, relief, rising):
    array = hills(relief, chunks=(100, 170), rising=rising)
    found = hl.dask.bake(array, client, maps=MAPS, window=192, error=0.01)
    expected = hl.bake(array.heightlight.heightmap(), MAPS, error=0.01)
    assert_same(found, {name: values[:: -1 if rising else 1] for name, values in expected.items()})
    xr.testing.assert_equal(found.coords.to_dataset(), array.coords.to_dataset())
    assert found["ao"].attrs["source"] == "made" and "_FillValue" not in found["ao"].attrs
    assert found["ao"].dims == array.dims and np.isnan(found["ao"].values).sum() == 91
    assert hasattr(found["ao"].data, "dask")


def test_chunks_are_made_once_each(client, relief, tmp_path):
    import dask.array

    def make(block):
        (tmp_path / uuid.uuid4().hex).with_suffix(".made").touch()
        return block

    lazy = dask.array.from_array(relief, chunks=128).map_blocks(make, meta=relief[:0, :0])
    found = hl.dask.bake(xr.DataArray(lazy, dims=("y", "x")), client, window=128, texel=5, error=0.02)
    assert len(list(tmp_path.glob("*.made"))) == 16
    np.testing.assert_array_equal(found["ao"].values, hl.bake(relief.astype(float), texel=5, boundary="open", error=0.02)["ao"])


def test_horizons_harmonics_and_a_reach_too(client, relief):
    options = dict(maps=("ao", "horizon", "sh", "bent-cone", "normal", "height"), max_distance=150, falloff="linear", horizon_azimuths=6, error=0.02)
    array = hills(relief)  # no chunks of its own
    found = hl.dask.bake(array, client, window=256, **options)
    assert_same(found, hl.bake(array.heightlight.heightmap(), **options))


def test_work_goes_on_where_it_was(client, relief):
    source = saved("fbm.npy", relief)

    class Enough(Exception):
        pass

    def stop(step, done, total, ended):
        if step == "sky" and ended:
            raise Enough

    with pytest.raises(Enough):
        hl.dask.bake(source, client, window=128, texel=5, error=0.01, progress=stop)
    made = {file.name: file.stat().st_mtime_ns for file in os.scandir("fbm.windows/sky")}
    assert len(made) == 16
    steps = []
    found = hl.dask.bake(source, client, window=128, texel=5, error=0.01, progress=lambda step, *_: steps.append(step))
    assert set(steps) == {"check", "textures"}  # the sky was whole
    assert_same(found, hl.bake(hl.read(source, texel=5), error=0.01))


def test_bad_input_is_told(client, relief, tmp_path):
    source = saved("fbm.npy", relief)
    (tmp_path / "words.png").write_text("no picture\n")
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "letter.txt").write_text("keep me\n")
    array = hills(relief)
    bake = hl.dask.bake
    cases = [
        (ValueError, "window", lambda: bake(source, client, window=100)),
        (ValueError, "window", lambda: bake(source, client, window="wide")),
        (ValueError, "ao-n", lambda: bake(source, client, maps="ao-n")),
        (ValueError, "openness", lambda: bake(source, client, maps="openness-positive")),
        (ValueError, "max_distance: multibounce", lambda: bake(source, client, maps="multibounce", max_distance=3)),
        (ValueError, "albedo", lambda: bake(source, client, maps="multibounce", albedo=np.ones((512, 512)))),
        (ValueError, "below_horizontal", lambda: bake(source, client, maps="multibounce", below_horizontal="ground")),
        (ValueError, "no map", lambda: bake(source, client, maps="oa")),
        (ValueError, "name", lambda: bake(source, client, name="a/b")),
        (ValueError, "format", lambda: bake(source, client, output="out", format="gif")),
        (ValueError, "relief", lambda: bake(array, client, relief=2)),
        (ValueError, "two; choose a band", lambda: bake(array.expand_dims("band"), client)),
        (ValueError, "all are missing", lambda: bake(array * np.nan, client, window=256)),
        (ValueError, "infinite", lambda: bake(array * np.inf, client, window=256)),
        (ValueError, "texel", lambda: bake(array, client, window=256, texel=-1)),
        (ValueError, "boundary", lambda: bake(array, client, window=256, boundary="round")),
        (MemoryError, "smaller window", lambda: bake(array, client, window=256, memory=1 << 20)),
        (OSError, "words.png", lambda: bake("words.png", client)),
        (OSError, "nowhere.tif", lambda: bake("nowhere.tif", client)),
        (OSError, "/proc/nowhere", lambda: bake(source, client, folder="/proc/nowhere")),
        (OSError, "mine", lambda: bake(source, client, folder="mine")),
    ]
    for kind, words, call in cases:
        with pytest.raises(kind) as raised:
            call()
        assert words in str(raised.value), raised.value
        assert "\n" not in str(raised.value) and "--" not in str(raised.value), raised.value
    assert (tmp_path / "mine" / "letter.txt").read_text() == "keep me\n"
    assert not os.path.exists("out")


def test_what_the_folder_lost_is_told_when_it_is_read(client, relief):
    import shutil

    found = hl.dask.bake(saved("fbm.npy", relief), client, window=256, texel=5, error=0.02)
    hl.dask.bake("fbm.npy", client, maps="bent-normal", window=256, texel=5, error=0.02)  # into the same folder
    with pytest.raises(OSError, match="fbm.windows: does not hold these maps"):
        found["ao"].values
    shutil.rmtree("fbm.windows")
    with pytest.raises(OSError, match="fbm.windows"):
        found["ao"].values


def test_a_dataset_is_what_one_process_makes(client, command, tmp_path):
    program = os.path.abspath(os.environ["HEIGHTLIGHT_COMMAND"]) if "HEIGHTLIGHT_COMMAND" in os.environ else None
    manifest = {"maps": [{"shape": "brick", "size": 48}, {"shape": "cobbles", "size": 48}], "relief_shares": [0.05, 0.2], "options": [{"name": "walked", "error": 0.02}]}
    (tmp_path / "study.json").write_text(json.dumps(manifest))
    command("dataset", "study.json", "-o", "alone", "--quiet")
    tables = hl.dask.dataset("study.json", client, "shared", shards=3, command=program)
    assert [table.name for table in tables] == ["dataset.csv", "dataset.json", "costs.csv"]
    for table in tables[:2]:
        assert table.read_bytes() == (tmp_path / "alone" / table.name).read_bytes()
    (tmp_path / "wrong.json").write_text('{"maps": 3}')
    with pytest.raises((ValueError, OSError), match="wrong.json"):
        hl.dask.dataset("wrong.json", client, "other", command=program)
    with pytest.raises(FileNotFoundError, match="no_such_program"):
        hl.dask.dataset("study.json", client, "other", command="no_such_program")


def test_the_example_of_the_documentation_runs(tmp_path):
    section = (Path(__file__).resolve().parents[2] / "docs" / "cluster.md").read_text().split("## Dask")[1]
    code = section.split("```python\n", 1)[1].split("```", 1)[0]
    assert "LocalCluster" in code
    (tmp_path / "example.py").write_text(code)
    done = subprocess.run([sys.executable, "example.py"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    mean, files = done.stdout.splitlines()
    assert 0.9 < float(mean) < 1 and files == "maps/hills_ao.tif maps/hills_bake.json"


def test_without_distributed_it_says_what_is_missing():
    code = "import sys; sys.modules['distributed'] = None; import heightlight as hl; hl.dask"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 1 and "python3-distributed" in done.stderr.splitlines()[-1]
