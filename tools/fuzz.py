#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fuzzes everything that reads a file of a user: `tools/fuzz.py PROGRAM [--seconds 600] [--only case]`.

Builds tests/fuzz with clang's libFuzzer, the address sanitizer and the one of undefined behaviour in build/fuzz, and runs each
target for so many seconds, beginning with shipped files and, for checkpoint and results, with what PROGRAM (dem4grm) writes
for a small test. Inputs that were found stay in build/fuzz/corpus for the next time. A crash, a sanitizer report, a foreign
exception or an input that takes longer than a second (a study: 30) ends the target with the input in build/fuzz/findings. Exit code 1 if
there was one.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "fuzz"
TEXTS = {"case": ["cases/*.toml", "cases/paper/direct-shear.toml"], "study": ["cases/paper/campaign.toml", "cases/studies/*.toml"],
         "grading": ["cases/gradings/*.csv"], "clumps": ["cases/clumps/*.csv"],
         "published": ["cases/paper/published.csv"], "laboratory": []}
FILES = {"checkpoint": "checkpoint.h5", "results": "results.h5"}
CURVES = ("Shear box;;\nHorizontal displacement (mm);Shear stress (kPa);Vertical displacement (mm)\n0;0;0\n0,5;45;-0,02\n2;70;0,1\n",
          "u [cm],tau [MPa],settlement [um]\n0,0,0\n0.05,0.045,20\n", "displacement\tshear force (kN)\n0\t0\n1e-1\t.2\n")
PATIENCE = {"study": 30}  # s; a study reads its case once for every test, and may have many
LONGEST = {"checkpoint": 4_000_000, "results": 4_000_000}


def build():
    options = ["-DCMAKE_BUILD_TYPE=RelWithDebInfo", "-DCMAKE_C_COMPILER=clang-14", "-DCMAKE_CXX_COMPILER=clang++-14",
               "-DDEM4GRM_SANITIZE=fuzzer-no-link,address,undefined", "-DDEM4GRM_BUILD_FUZZ=ON", "-DDEM4GRM_UNITY=ON",
               "-DDEM4GRM_WERROR=OFF", "-DCMAKE_CXX_FLAGS=-w", "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g1"]
    subprocess.run(["cmake", "-G", "Ninja", "-S", ROOT, "-B", BUILD] + options, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", BUILD, "--target", "fuzz_readers"], check=True)


def seeds(target, program, folder):
    folder.mkdir(parents=True, exist_ok=True)
    for pattern in TEXTS.get(target, []):
        for path in ROOT.glob(pattern):
            shutil.copy(path, folder / path.name)
    for k, text in enumerate(CURVES if target == "laboratory" else ()):
        (folder / f"curve{k}.csv").write_text(text, encoding="utf-8")
    if target in FILES:
        made = BUILD / "run"
        shutil.rmtree(made, ignore_errors=True)
        words = ["run", ROOT / "cases/studies/small-box.toml", "-q", "-j", "1", "-o", made, "--set", "specimen.rubber_content=0.05",
                 "--set", "box.length=18 mm", "--set", "box.width=18 mm", "--set", "shear.displacement=0.1 mm"]
        if target == "checkpoint":
            words += ["--max-hours", "0.0002"]
        subprocess.run([program] + words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        shutil.copy(made / FILES[target], folder / FILES[target])


def fuzz(target, options):
    corpus, findings = BUILD / "corpus" / target, BUILD / "findings"
    seeds(target, options.program, corpus)
    findings.mkdir(parents=True, exist_ok=True)
    words = [BUILD / "tests" / "fuzz_readers", corpus, f"-max_total_time={options.seconds}", f"-timeout={PATIENCE.get(target, 1)}", "-rss_limit_mb=4096",
             f"-max_len={LONGEST.get(target, 65536)}", f"-artifact_prefix={findings}/{target}-", "-print_final_stats=1"]
    # libhdf5 1.10 leaks a little on its way out of a damaged file, and asks for as much memory as a damaged header says; it
    # handles that it gets none.
    options_of_sanitizer = "allocator_may_return_null=1:detect_leaks=0" if target in FILES else "detect_leaks=1"
    environment = os.environ | {"DEM4GRM_FUZZ_TARGET": target, "OMP_NUM_THREADS": "1", "ASAN_OPTIONS": options_of_sanitizer}
    result = subprocess.run(words, env=environment, capture_output=True, text=True, errors="replace")
    runs = re.search(r"number_of_executed_units: (\d+)", result.stderr)
    print(f"{target:12} {runs.group(1) if runs else '?':>10} inputs  {'clean' if result.returncode == 0 else 'FINDING'}", flush=True)
    if result.returncode != 0:
        print(result.stderr[-4000:])
    return result.returncode == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path, help="dem4grm, which makes a checkpoint and results to begin with")
    parser.add_argument("--seconds", type=int, default=600, help="of each target")
    parser.add_argument("--only", choices=[*TEXTS, *FILES], help="this target")
    options = parser.parse_args()
    build()
    good = [fuzz(target, options) for target in ([options.only] if options.only else [*TEXTS, *FILES])]
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
