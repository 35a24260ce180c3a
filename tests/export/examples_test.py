#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs every script of examples/python: `examples_test.py DEM4GRM`.

The numbers that they print must be those of `dem4grm micro`, summary.json and envelopes.csv, which know nothing of them; each must leave a picture
with something on it. Not tested here: whether the pictures are beautiful.
"""
import contextlib
import io
import pathlib
import runpy
import sys
import tempfile
import unittest
import warnings

import h5py
import matplotlib.image
import numpy as np

import tiny_runs

PROGRAM = ""
EXAMPLES = tiny_runs.ROOT / "examples/python"
sys.path.insert(0, str(EXAMPLES))


class Examples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="dem4grm-examples-")
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        tiny_runs.run_tiny(PROGRAM, cls.folder)
        tiny_runs.run_grain(PROGRAM, cls.folder)
        tiny_runs.run_study(PROGRAM, cls.folder)
        cls.seen = set()

    def draw(self, script, *words):
        """What the script says; its picture must have ink on it."""
        picture = self.folder / f"{script}.png"
        said = io.StringIO()
        sys.argv = [f"{script}.py", *map(str, words), "-o", str(picture)]
        with contextlib.redirect_stdout(said), contextlib.chdir(self.folder), warnings.catch_warnings():
            warnings.simplefilter("error")
            runpy.run_path(str(EXAMPLES / f"{script}.py"), run_name="__main__")  # a process each would take twice as long
        self.assertIn(str(picture), said.getvalue())
        ink = matplotlib.image.imread(picture)[..., :3].min(axis=2) < 0.9
        self.assertTrue(0.005 < ink.mean() < 0.9, f"{script}: {ink.mean()} of the picture is not white")
        type(self).seen.add(f"{script}.py")
        return said.getvalue()

    def test_shear_curves(self):
        tests = sorted(str(p.relative_to(self.folder)) for p in self.folder.glob("study/tests/*"))
        self.assertEqual(len(tests), 4)
        said = self.draw("shear_curves", "shear", *tests)
        for name in ("shear", *tests):
            self.assertIn(tiny_runs.peak_line(self.folder, name), said)

    def test_polar_histograms(self):
        said = self.draw("polar_histograms", "shear", "--at", 0, 0.52)
        for at in (0, 0.5):
            self.assertIn(tiny_runs.numbers_of(PROGRAM, self.folder, "shear", at), said)

    def test_anisotropy(self):
        self.draw("anisotropy", "shear", *sorted(self.folder.glob("study/tests/*")))

    def test_strong_network(self):
        said = self.draw("strong_network", "shear", "--at", 1)
        with h5py.File(self.folder / "shear/results.h5") as file:
            frame = file["frames"][sorted(file["frames"])[-1]]
            force, is_wall = frame["contacts/normal_force"][:], frame["contacts/wall"][:] >= 0
            grains = np.column_stack([frame["contacts/body_i"][:], frame["contacts/body_j"][:]]) < len(frame["rubber_grains/centre"])
        strong = ~is_wall & (force > force[~is_wall].mean())
        for rubber, kind in enumerate(("gravel-gravel", "gravel-rubber", "rubber-rubber")):
            count = (strong & (grains.sum(axis=1) == rubber)).sum()
            self.assertIn(f"{kind}: {count} of {strong.sum()} strong contacts", said)

    def test_campaign(self):
        said = self.draw("campaign", "study/collected")
        lines = tiny_runs.envelope_lines(self.folder)
        self.assertEqual(len(lines), 2)
        for line in lines:
            self.assertIn(line, said)

    def test_grain_compression(self):
        rows = (self.folder / "grain/grain.csv").read_text(encoding="utf-8").splitlines()
        load = float(rows[-1].split(",")[rows[0].split(",").index("load_N")])
        self.assertIn(f"load at 10 %: {load:.3f} N", self.draw("grain_compression", "grain"))

    @classmethod
    def tearDownClass(cls):
        there = {p.name for p in EXAMPLES.glob("*.py")} - {"test_folder.py"}
        assert cls.seen == there, f"examples without a test: {there - cls.seen}"


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=1)
