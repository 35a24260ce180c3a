# SPDX-License-Identifier: BSD-3-Clause
"""Builds the extension and the program with CMake and puts them into the wheel.

DEM4GRM_BUILD_DIR names a folder that was configured with -DDEM4GRM_BUILD_PYTHON=ON and built; without it the sources are built in
build/python, which takes some minutes.
"""
import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent.parent


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        folder = os.environ.get("DEM4GRM_BUILD_DIR")
        if folder is None:
            folder = ROOT / "build" / "python"
            subprocess.run(
                ["cmake", "-S", ROOT, "--preset", "release", "-B", folder, "-DDEM4GRM_BUILD_PYTHON=ON", "-DDEM4GRM_BUILD_TESTS=OFF",
                 "-DDEM4GRM_UNITY=ON", f"-DPython_EXECUTABLE={sys.executable}"], cwd=ROOT, check=True)
            subprocess.run(["cmake", "--build", folder, "--parallel", str(os.cpu_count()), "--target", "dem4grm_python"], check=True)
        target = Path(self.get_ext_fullpath(ext.name)).resolve().parent.parent
        subprocess.run(["cmake", "--install", folder, "--component", "python", "--prefix", target, "--strip"], check=True)


version = re.search(r"project\(dem4grm VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")).group(1)
setup(version=version, ext_modules=[Extension("dem4grm._core", sources=[])], cmdclass={"build_ext": CMakeBuild})
