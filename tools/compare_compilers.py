#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Do other compilers and levels of optimisation give the same bits? `tools/compare_compilers.py BUILD [--compiler g++ --compiler clang++-14]`.

BUILD is a build folder with the tests (the preset `release`), in which the engine lies as two sources for the Arm test. They are compiled
here by each compiler with -O1, -O2 and -O3, once for every x86-64 processor of the last fifteen years and once for those with AVX2, run on 1, 2, 3 and
8 threads, and the state hashes of four small scenes are compared. Minutes; exit code 1 when one differs.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
LEVELS, PROCESSORS, THREADS = ("-O1", "-O2", "-O3"), ("x86-64-v2", "x86-64-v3"), (1, 2, 3, 8)


def floating_point_rules():
    """The flags of cmake/FloatingPoint.cmake, which alone holds them."""
    text = (ROOT / "cmake/FloatingPoint.cmake").read_text(encoding="utf-8")
    return re.search(r"target_compile_options\(dem4grm_floating_point INTERFACE\s+([^)]+)\)", text)[1].split()


def build(compiler, level, processor, sources, generated, folder):
    options = ["-std=c++20", level, f"-march={processor}", "-fopenmp", "-w", *floating_point_rules(), "-DEIGEN_DONT_VECTORIZE", "-DFMT_HEADER_ONLY",
               "-DXXH_INLINE_ALL", f"-I{ROOT / 'src'}", f"-I{ROOT / 'tests'}", f"-I{generated}", "-isystem", "/usr/include/eigen3"]
    program = folder / "state_hashes"
    subprocess.run([compiler, *options, *sources, "-o", program], check=True)
    return program


def hashes(program, threads):
    return subprocess.run([program], check=True, capture_output=True, text=True, env=os.environ | {"OMP_NUM_THREADS": str(threads)}).stdout.split()


def main():
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("build", type=pathlib.Path)
    words.add_argument("--compiler", action="append")
    options = words.parse_args()
    arm = options.build / "tests/determinism/arm64"
    sources = [arm / "engine.cpp", arm / "kernels.cpp"]
    missing = [str(s) for s in sources if not s.exists()]
    if missing:
        sys.exit(f"{', '.join(missing)}: not there; configure {options.build} with its tests and the cross-compiler for Arm")
    expected, differing, compared = None, 0, 0
    for compiler in options.compiler or ["g++", "clang++-14"]:
        if shutil.which(compiler) is None:
            sys.exit(f"{compiler}: is not installed")
        for level in LEVELS:
            for processor in PROCESSORS:
                with tempfile.TemporaryDirectory() as folder:
                    program = build(compiler, level, processor, sources, options.build / "generated", pathlib.Path(folder))
                    for threads in THREADS:
                        found = hashes(program, threads)
                        expected = expected or found
                        is_same = found == expected and len(found) == 4
                        differing += not is_same
                        compared += 1
                        print(f"{compiler} {level} {processor}, {threads} threads: {'same' if is_same else 'DIFFERS'} {' '.join(h[:8] for h in found)}", flush=True)
    print(f"{compared - differing} of {compared} give the same bits")
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
