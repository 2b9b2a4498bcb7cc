"""What tests share."""

import os
import subprocess

import numpy as np
import pytest

import heightlight as hl


@pytest.fixture
def command(tmp_path):
    """Runs the command line in a folder of its own; Path of it."""

    def run(*arguments):
        program = os.environ.get("HEIGHTLIGHT_COMMAND")
        if not program:
            pytest.skip("HEIGHTLIGHT_COMMAND names no program: NOT COMPARED")
        done = subprocess.run([program, *map(str, arguments)], cwd=tmp_path, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return tmp_path

    return run


@pytest.fixture(scope="session")
def brick():
    return hl.synth("brick", 64)


@pytest.fixture(scope="session")
def brick_operator(brick):
    return hl.operator(brick)


@pytest.fixture
def holed(brick):
    heights = brick.height.copy()
    heights[3:6, 10:14] = np.nan
    return hl.Heightmap(heights, brick.texel, "open")
