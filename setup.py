"""Builds the compiled part of the package with CMake. HEIGHTLIGHT_BUILD names a build folder to use and keep."""

import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = Path(__file__).resolve().parent
VERSION = re.search(r"project\(heightlight VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]


class CMakeBuild(build_ext):
    """Makes the one extension that there is."""

    def build_extension(self, extension):
        folder = Path(os.environ.get("HEIGHTLIGHT_BUILD", Path(self.build_temp) / "cmake")).resolve()
        options = [f"-DPython3_EXECUTABLE={sys.executable}", "-DHEIGHTLIGHT_PYTHON=ON"]
        if not (folder / "CMakeCache.txt").exists():
            options += ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON"]
            options += [f"-DHEIGHTLIGHT_{part}=OFF" for part in ("CLI", "TESTS", "INSTALL")]
        subprocess.run(["cmake", "-S", SOURCE, "-B", folder, *options], check=True)
        subprocess.run(["cmake", "--build", folder, "--target", "heightlight_python"], check=True)
        name = Path(self.get_ext_fullpath(extension.name))
        name.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(folder / "python" / "heightlight" / name.name), str(name))


setup(version=VERSION, ext_modules=[Extension("heightlight._native", [])], cmdclass={"build_ext": CMakeBuild})
