#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Types the commands of the how-to pages about other programs, as their reader would: `pages_test.py DEM4GRM`.

Blocks marked `sh` and `python` are run, with a tiny test in place of runs/quick; what needs ParaView's window stands in blocks without a mark.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import tiny_runs

PROGRAM = ""
PAGES = ("paraview.md", "exchange-with-laboratories.md")
INTERPRETERS = {"sh": ["bash", "-ec"], "python": ["/usr/bin/python3", "-c"]}


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="dem4grm-pages-")
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        (cls.folder / "cases").symlink_to(tiny_runs.ROOT / "cases")
        (cls.folder / "bin").mkdir()
        (cls.folder / "bin/dem4grm").symlink_to(PROGRAM)
        (cls.folder / "bin/python3").symlink_to("/usr/bin/python3")
        cls.quick = tiny_runs.run_tiny(PROGRAM, cls.folder, "runs/quick")

    def type_page(self, page):
        """What each block said."""
        text = (tiny_runs.ROOT / "docs/how-to" / page).read_text(encoding="utf-8")
        environment = {**os.environ, "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}"}
        said = []
        for language, block in re.findall(r"^```(sh|python)\n(.*?)^```", text, re.M | re.S):
            done = subprocess.run([*INTERPRETERS[language], block], cwd=self.folder, env=environment, capture_output=True,
                                  text=True, check=False)
            self.assertEqual(done.returncode, 0, f"{page}\n{block}\n{done.stdout}{done.stderr}")
            said.append(done.stdout)
        return said

    def test_paraview(self):
        try:
            import vtkmodules  # noqa: F401
        except ImportError as missing:
            self.skipTest(str(missing))
        exported, read = self.type_page("paraview.md")
        self.assertIn("paraview --script=runs/quick/vtk/view.py", exported)
        self.assertRegex(read, r"^[0-9.]+ N$")

    def test_exchange(self):
        numbers, = self.type_page("exchange-with-laboratories.md")
        facts = json.loads((self.folder / "runs/exchange/summary.json").read_text(encoding="utf-8"))
        self.assertEqual(numbers.split(), [str(facts["peak_shear_stress_kPa"]), str(facts["vertical_displacement_at_peak_mm"])])
        page = (tiny_runs.ROOT / "docs/how-to/exchange-with-laboratories.md").read_text(encoding="utf-8")
        names = re.findall(r"^\| `(\w+)`", page, re.M)
        self.assertGreater(len(names), 10)
        self.assertEqual([name for name in names if name not in facts and name != "summary"], [])

    def test_numbers_of_a_strength_are_those_of_the_record(self):
        """Peak and its displacements from shear.csv, by running means of ten rows of 0.01 mm."""
        facts = json.loads((self.quick / "summary.json").read_text(encoding="utf-8"))
        lines = [line.split(",") for line in (self.quick / "shear.csv").read_text(encoding="utf-8").splitlines()]
        rows = [dict(zip(lines[0], map(float, line))) for line in lines[1:]]
        windows = [rows[k:k + 10] for k in range(len(rows) - 9)]

        def mean(window, name):
            return sum(row[name] for row in window) / len(window)

        best = max(windows, key=lambda window: mean(window, "shear_stress_kPa"))
        for name, column in (("peak_shear_stress_kPa", "shear_stress_kPa"), ("displacement_at_peak_mm", "displacement_mm"),
                             ("vertical_displacement_at_peak_mm", "vertical_displacement_mm"),
                             ("normal_stress_at_peak_kPa", "normal_stress_kPa")):
            self.assertAlmostEqual(facts[name] / mean(best, column), 1.0, places=9, msg=name)
        self.assertIsNone(facts["displacement_at_residual_mm"], "1 mm of shear has no residual strength")


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=1)
