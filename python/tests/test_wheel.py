# SPDX-License-Identifier: BSD-3-Clause
"""The wheel: built from what this build made, installed where nothing else of the package is, used from there."""
import ast
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import dem4grm

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


def test_the_stub_names_what_there_is():
    """Functions and classes of the extension, and the members of the classes whose stub lists them."""
    tree = ast.parse((SOURCE / "dem4grm" / "_core.pyi").read_text(encoding="utf-8"))
    classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
    functions = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
    real = {name for name in vars(dem4grm._core) if not name.startswith("_")} - {"version", "commit", "compiler"}
    assert real == functions | set(classes)
    for name, node in classes.items():
        listed = {n.name for n in node.body if isinstance(n, ast.FunctionDef)} | {
            n.target.id for n in node.body if isinstance(n, ast.AnnAssign)}
        members = {m for m in vars(getattr(dem4grm._core, name)) if not m.startswith("_")}
        assert "__getattr__" in listed or members == {m for m in listed if not m.startswith("_")}, name


def test_everything_public_is_described():
    for name in dem4grm.__all__:
        thing = getattr(dem4grm, name)
        assert thing.__doc__, name
        for member, value in vars(thing).items() if isinstance(thing, type) else ():
            if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                assert getattr(value, "__doc__", None) or member in SELF_EXPLAINING, f"{name}.{member}"


SELF_EXPLAINING = {"name", "copy", "tests", "warnings", "displacement_mm", "rubber_grains", "walls", "log", "first", "last", "steps",
                   "threads", "steps_per_second", "force", "is_complete", "density", "friction", "shear_modulus", "poisson_ratio"}
