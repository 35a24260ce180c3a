# SPDX-License-Identifier: BSD-3-Clause
"""The wheel: built from what this build made, installed where nothing else of the package is, used from there."""
import os
import subprocess
import sys
import zipfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent


def test_a_wheel_installs_and_works(tmp_path):
    copy = tmp_path / "python"  # the build of a wheel leaves files beside the sources
    for name in ("pyproject.toml", "setup.py"):
        copy.mkdir(exist_ok=True)
        (copy / name).write_bytes((SOURCE / name).read_bytes())
    (copy / "dem4grm").symlink_to(SOURCE / "dem4grm")
    (tmp_path / "CMakeLists.txt").symlink_to(SOURCE.parent / "CMakeLists.txt")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "-q"]
    subprocess.run([*pip, "wheel", "--no-index", "--no-build-isolation", "--no-deps", "-w", tmp_path, copy], check=True)
    (wheel,) = tmp_path.glob("dem4grm-*-cp311-cp311-linux_*.whl")
    names = set(zipfile.ZipFile(wheel).namelist())
    assert {"dem4grm/_core.pyi", "dem4grm/py.typed", "dem4grm/dem4grm", "dem4grm/__init__.py"} <= names
    subprocess.run([*pip, "install", "--no-index", "--no-deps", "--target", tmp_path / "site", wheel], check=True)
    code = ("import dem4grm, subprocess; print(dem4grm.__file__);"
            "print(subprocess.run([dem4grm.program(), '--version'], capture_output=True, text=True).stdout.split()[1]);"
            "assert dem4grm.verify('servo-approach', threads=1).attrs['missed'] == 0")
    answer = subprocess.run([sys.executable, "-c", code], env={**os.environ, "PYTHONPATH": str(tmp_path / "site")}, cwd=tmp_path,
                            capture_output=True, text=True, check=True)
    place, version = answer.stdout.split()
    assert place.startswith(str(tmp_path / "site")) and version in wheel.name
