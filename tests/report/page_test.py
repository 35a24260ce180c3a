#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The report page of a real test, of a campaign and of a grain compression, opened from disk in headless Chromium.

    page_test.py PROGRAM SOURCE [--shots FOLDER] [--demo]

Runs a small mixture with a laboratory's curve, four tests of a campaign and a short grain compression, and hands their reports to
web/test/browser.mjs, which holds them to what a reader relies on. --demo adds cases/quick.toml and cases/studies/quick.toml, some
minutes; --shots keeps pictures of the pages for a person to look at. Exit code 77, which ctest counts as skipped, without the page, node
or Chromium.
"""
import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

CASE = """name = "mixture"
seed = 3
[specimen]
rubber_content = 0.3
preparation_friction = 0.3
generation_void_ratio = 0.85
gravel_grading = [["3.6 mm", 0.0], ["4.0 mm", 1.0]]
rubber_grading = [["3.6 mm", 0.0], ["3.8 mm", 1.0]]
[box]
length = "21 mm"
width  = "21 mm"
height = "21 mm"
upper_height = "40 mm"
[equilibrium]
force_ratio = 0.02
plate_speed = "5 mm/s"
stress_tolerance = 0.05
hold_steps = 200
[shear]
normal_stress = "100 kPa"
velocity      = "200 mm/s"
displacement  = "3 mm"
[recording]
frame_interval = "0.5 mm"
"""
STUDY = 'base = "case.toml"\n[set]\nshear.displacement = "2.2 mm"\n[axes]\nrubber_content = [0, 0.3]\nnormal_stress = ["60 kPa", "100 kPa"]\n'
LABORATORY = "Shear box, made up for a test\nHorizontal displacement (mm);Shear stress (kPa);Vertical displacement (mm)\n0;0;0\n0,5;45;-0,02\n2;70;0,1\n"


def skip(why):
    print("skipped:", why)
    sys.exit(77)


def make_pages(program, source, folder, has_demo):
    def run(*words):
        subprocess.run([program, *map(str, words)], cwd=folder, check=True, stdout=subprocess.DEVNULL)

    (folder / "case.toml").write_text(CASE)
    (folder / "study.toml").write_text(STUDY)
    (folder / "laboratory.csv").write_text(LABORATORY)
    run("run", "case.toml", "-o", "mixture", "-q")
    if not (folder / "mixture/report.html").exists():
        skip("this build of the program carries no page")
    run("report", "mixture", "--lab", "laboratory.csv", "-q")
    run("campaign", "run", "study.toml", "-o", "campaign", "-q", "-w", "2", "-j", "1")
    run("run", source / "cases/grain_compression.toml", "-o", "grain", "-q", "--set", "compression.plate_velocity=100 mm/s")
    pages = ["mixture", "campaign", "grain"]
    if has_demo:
        run("run", source / "cases/quick.toml", "-o", "quick", "-q")
        run("campaign", "run", source / "cases/studies/quick.toml", "-o", "quick-study", "-q")
        pages += ["quick", "quick-study"]
    # Under their own names, so that pictures do not overwrite each other.
    return [shutil.copy(folder / page / "report.html", folder / f"{page}.html") for page in pages]


def main():
    words = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    words.add_argument("program", type=pathlib.Path)
    words.add_argument("source", type=pathlib.Path)
    words.add_argument("--shots", type=pathlib.Path)
    words.add_argument("--demo", action="store_true")
    given = words.parse_args()
    source = given.source.resolve()
    chromium = shutil.which("chromium")
    if not chromium or not shutil.which("node") or not (source / "web/node_modules").is_dir():
        skip("needs node, chromium and the packages of web/ (tools/build_page.sh)")
    with tempfile.TemporaryDirectory() as name:
        pages = make_pages(given.program.resolve(), source, pathlib.Path(name), given.demo)
        options = ["--variants", "--chromium", chromium] + (["--shots", str(given.shots.resolve())] if given.shots else [])
        sys.exit(subprocess.run(["node", source / "web/test/browser.mjs", *options, *pages]).returncode)


if __name__ == "__main__":
    main()
