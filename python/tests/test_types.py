"""The package is typed, and its stubs are true."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import heightlight
import heightlight._native

pytest.importorskip("mypy")
PACKAGE = Path(heightlight.__file__).parent


def mypy(*arguments, folder):
    return subprocess.run(
        [sys.executable, "-m", *arguments], cwd=folder, capture_output=True, text=True, env={**os.environ, "MYPYPATH": str(PACKAGE.parent)}
    )


def test_the_package_and_a_caller_pass_mypy(tmp_path):
    (tmp_path / "caller.py").write_text(
        "import heightlight as hl\n"
        "sky: hl.Sky = hl.sky(hl.synth('brick', 8), error=0.01)\n"
        "mean: float = float(sky.sky_view_factor.mean())\n"
        "total = hl.operator([[0.0, 1.0], [0.0, 0.0]]).solve(0.5)\n"
        "wrong: str = hl.sky([[0.0]])\n"
    )
    done = mypy("mypy", "--ignore-missing-imports", "--disallow-untyped-defs", "caller.py", folder=tmp_path)
    assert done.stdout.count("error:") == 1 and "caller.py:5" in done.stdout, done.stdout
    done = mypy("mypy", "--ignore-missing-imports", "--disallow-untyped-defs", str(PACKAGE), folder=tmp_path)
    assert done.returncode == 0, done.stdout


def test_stubs_name_what_is_there():
    """Every name of the compiled part is in its stub, and the reverse."""
    import ast

    tree = ast.parse((PACKAGE / "_native.pyi").read_text())
    told = {}
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            told[node.name] = {one.name for one in node.body if isinstance(one, ast.FunctionDef)}
        elif isinstance(node, ast.FunctionDef):
            told[node.name] = None
        elif isinstance(node, ast.AnnAssign):
            told[node.target.id] = None
    there = {name for name in dir(heightlight._native) if not name.startswith("_")}
    assert there == set(told)
    for name, members in told.items():
        if members is not None:
            own = {member for member in vars(getattr(heightlight._native, name)) if not member.startswith("_")}
            assert own == members - {"__init__"}
