"""The examples run, and leave a picture."""

import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "python"


@pytest.mark.parametrize("name", sorted(path.stem for path in EXAMPLES.glob("*.py")))
def test_example(name, tmp_path):
    for package in ("matplotlib", "scipy", "rioxarray" if name == "terrain" else "numpy"):
        pytest.importorskip(package)
    done = subprocess.run([sys.executable, str(EXAMPLES / f"{name}.py"), "out"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "out" / f"{name}.png").stat().st_size > 20_000


def test_there_are_four():
    assert len(list(EXAMPLES.glob("*.py"))) == 4
