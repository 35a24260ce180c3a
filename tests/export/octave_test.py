#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the scripts of examples/matlab in GNU Octave: `octave_test.py DEM4GRM`.

The numbers that they print must be those of `dem4grm micro`, micro.csv, summary.json and envelopes.csv. Ends with 77 where Octave, gnuplot,
Ghostscript or h5dump are missing: `tools/install_dependencies.sh octave` installs them. Not tested here: MATLAB itself.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import matplotlib.image

import tiny_runs

PROGRAM = ""
EXAMPLES = tiny_runs.ROOT / "examples/matlab"
PICTURES = ("curves", "polar", "anisotropy", "envelopes")


class Octave(unittest.TestCase):
    def test_every_script_draws_and_says_the_numbers_of_the_program(self):
        with tempfile.TemporaryDirectory(prefix="dem4grm-octave-") as name:
            folder = pathlib.Path(name)
            tiny_runs.run_tiny(PROGRAM, folder)
            tiny_runs.run_study(PROGRAM, folder)
            said = self.octave(folder, "shear_curves({'shear', 'study/tests/vrc020-100kPa'}, 'curves.png'); "
                                       "polar_histograms('shear', [0 0.5], 'polar.png'); "
                                       "anisotropy('shear', 'anisotropy.png'); "
                                       "mohr_envelopes('study/collected', 'envelopes.png');")
            wanted = [tiny_runs.peak_line(folder, test) for test in ("shear", "study/tests/vrc020-100kPa")]
            wanted += [tiny_runs.numbers_of(PROGRAM, folder, "shear", at) for at in (0, 0.5)]
            wanted += tiny_runs.envelope_lines(folder)
            rows = [line.split(",") for line in (folder / "shear/micro.csv").read_text(encoding="utf-8").splitlines()]
            end = dict(zip(rows[0], map(float, rows[-1])))
            wanted.append(f"at the end: a {end['a_all']:.4f}, a_n {end['a_n_all']:.4f}, theta_n {end['theta_n_all_deg']:.2f}")
            for line in wanted:
                self.assertIn(line, said)
            for picture in PICTURES:
                ink = matplotlib.image.imread(folder / f"{picture}.png")[..., :3].min(axis=2) < 0.9
                self.assertTrue(0.005 < ink.mean() < 0.9, f"{picture}: {ink.mean()} of it is not white")

    def octave(self, folder, commands):
        done = subprocess.run(["octave-cli", "--norc", "--no-window-system", "--eval", f"addpath('{EXAMPLES}'); {commands}"],
                              cwd=folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    absent = [tool for tool in ("octave-cli", "gnuplot", "gs", "h5dump") if shutil.which(tool) is None]
    if absent:
        print(f"octave_test: no {', '.join(absent)}; tools/install_dependencies.sh octave installs what is missing")
        sys.exit(77)
    unittest.main(verbosity=1)
