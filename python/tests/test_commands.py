"""What the package finds is what the command line finds, to the last bit."""

import json

import numpy as np
import pytest

import heightlight as hl

pytestmark = pytest.mark.filterwarnings("ignore::UserWarning")  # results are read back as if they were heights


def check_same(values, path):
    """That a float image holds these values: as the library reads one, above the lowest, which it says, too."""
    read = hl.read(path)
    lowest = np.nanmin(values)
    assert lowest == np.float32(read.base)
    above = (values.astype(np.float64) - lowest).astype(np.float32)
    np.testing.assert_array_equal(above, read.height)


@pytest.fixture
def files(command):
    folder = command("synth", "brick", "-o", "brick.exr", "--size", 96)
    return command, folder


def test_sky(files):
    command, folder = files
    command("bake", "brick.exr", "-o", "out", "--maps", "ao", "--relief", 0.1, "--error", 0.001, "--format", "exr", "--depth", "float", "--quiet")
    check_same(hl.sky(hl.synth("brick", 96)).sky_view_factor, folder / "out/brick_ao.exr")


def test_synth_and_read_agree(files):
    _, folder = files
    np.testing.assert_array_equal(hl.synth("brick", 96).height, hl.read(folder / "brick.exr", relief=0.1).height)


@pytest.mark.parametrize("options", [{"error": 2e-3}, {"error": 0}, {"rays": 64}])
def test_totals_bounces_and_curves(files, options):
    command, folder = files
    arguments = [f"--{name}={value}" for name, value in options.items()]
    command("simulate", "brick.exr", "-o", "run", "--relief", 0.1, "--albedo", 0.8, "--bounces", 4, "--save-bounces", "--quiet", *arguments)
    op = hl.operator(hl.synth("brick", 96), **options)
    check_same(op.solve(0.8).astype(np.float32), folder / "run/irradiance_total.exr")
    check_same(op.sky_view_factor, folder / "run/sky_view_factor.exr")
    check_same(op.ambient_occlusion, folder / "run/ambient_occlusion.exr")
    bounces = op.bounces(4)
    for b in range(5):
        check_same(bounces[b].astype(np.float32), folder / f"run/irradiance_{b:02}.exr")
    rows = [line.split(",") for line in (folder / "run/curves.csv").read_text().splitlines()[1:]]
    curves = op.curves(bounces=4)
    ours = curves["bounce"] >= 0
    assert [row[0] for row in rows] == curves["ao_kind"][ours].tolist()
    for column, name in ((1, "bin"), (4, "ao_mean"), (5, "count"), (6, "bounce"), (7, "mean"), (11, "p95")):
        np.testing.assert_array_equal(np.array([float(row[column]) for row in rows]), curves[name][ours])


def test_bakes(files):
    command, folder = files
    maps = ["ao", "multibounce", "bent-normal", "ao-n"]
    command("bake", "brick.exr", "-o", "out", "--maps", ",".join(maps), "--relief", 0.1, "--quiet")
    bake = hl.bake(hl.synth("brick", 96), maps)
    names = bake.save(folder / "own", "brick")
    for name in names:
        if name.endswith(".png"):
            assert (folder / "own" / name).read_bytes() == (folder / "out" / name).read_bytes()
    said = json.loads((folder / "own/brick_bake.json").read_text())
    assert {file["file"] for file in said["files"]} == {name for name in names if name.endswith(".png")}


def test_datasets_and_fits(files):
    command, folder = files
    command("synth", "cobbles", "-o", "cobbles.exr", "--size", 64)
    maps = {"brick": hl.read(folder / "brick.exr", relief=0.1), "cobbles": hl.read(folder / "cobbles.exr", relief=0.1)}
    runs = hl.dataset(maps, bounces=6)
    for name in maps:
        command("simulate", f"{name}.exr", "-o", f"runs/{name}", "--relief", 0.1, "--bounces", 6, "--quiet")
    command("fit", "runs/brick/curves.csv", "runs/cobbles/curves.csv", "-o", "models", "--bootstrap", 20, "--quiet")
    said = json.loads((folder / "models/models.json").read_text())
    found = hl.fit(runs, bootstrap=20)
    for own, told in zip(found["families"], said["families"]):
        assert own["name"] == told["name"]
        for one, other in zip(own["parameters"], told["parameters"]):
            assert one["value"] == pytest.approx(other["value"], rel=1e-6, abs=1e-9)  # n's mean is printed shorter
    runs.save(folder / "dataset.csv")
    command("fit", "dataset.csv", "-o", "again", "--bootstrap", 20, "--quiet")


def test_comparisons(files):
    command, folder = files
    command("synth", "brick", "-o", "small.exr", "--size", 24)
    command("compare", "small.exr", "-o", "out", "--relief", 0.1, "--albedo", 0.5, "--azimuths", 32, "--quiet")
    lines = (folder / "out/compare.csv").read_text().splitlines()
    head = lines[0].split(",")
    told = {}
    for line in lines[1:]:
        row = dict(zip(head, line.split(",")))
        told[row["method"], row["parameters"], row["quantity"]] = float(row["rmse"])
    found = hl.compare(hl.read(folder / "small.exr", relief=0.1), albedo=0.5, azimuths=32)
    assert len(found.rows) == len(lines) - 1
    for row in found.rows:
        parameters = row["parameters"] + ("; " + row["variant"] if row["variant"] else "")
        assert row["rmse"] == pytest.approx(told[row["method"], parameters, row["quantity"]], rel=1e-5)
    assert {line["ao"] for line in found.answer} >= {"exact AO", "GTAO as games run it"}
    assert found.to_pandas().shape[0] == len(found.rows)
