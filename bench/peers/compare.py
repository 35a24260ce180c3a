#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times DEM4GRM beside LAMMPS, LIGGGHTS and YADE on the same balls, in turn.

  bench/peers/compare.py [--rounds 3] [--cores 2] [--targets v4,v3] [--scene NAME] [--folder build/bench-peers]
                         [--install]

Prints CSV, one row for each run (round, scene, code, balls, touching pairs, steps, seconds, million ball-steps per
second), and at the end a table of medians and of the ratios of DEM4GRM to each code within a round. Programs that are
not installed are left out; --install installs those that Debian ships. DEM4GRM runs once for each of the processor
targets that are named, by default the best one. docs/performance.md says what the scenes are.
Exit codes: 0 done, 1 a program failed, 77 none of the others is installed.
"""
import argparse
import csv
import functools
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
YOUNG, POISSON, FRICTION = 234e6, 0.3, 0.5  # gravel: G = 90 MPa
DENSITY = 2710.0
# Steps that take some seconds, of each code; 0: it cannot do it. LAMMPS twice: with our contact law, and with the older
# and cheaper pair style gran/hertz/history.
CODES = ("dem4grm", "lammps", "lammps-fast", "liggghts", "yade")
STEPS = {"spheres": (4000, 1000, 1000, 1000, 150), "clumps": (8000, 1500, 1500, 0, 150),
         "clusters-1000": (4000, 0, 0, 0, 100), "clusters-6000": (600, 0, 0, 0, 15)}


def run(command, folder, log, cores, **more):
    """Output of a program that must succeed; `cores` threads or processes."""
    environment = dict(os.environ, **more, OMP_NUM_THREADS=str(cores), OMP_PROC_BIND="true", GOMP_SPINCOUNT="100000",
                       OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    done = subprocess.run([str(word) for word in command], cwd=folder, env=environment, text=True, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    (folder / log).write_text(done.stdout, encoding="utf-8")
    if done.returncode != 0:
        raise RuntimeError(f"{command[0]} ended with {done.returncode}:\n{done.stdout[-2000:]}")
    return done.stdout


def balls_of(folder, scene):
    with open(folder / f"{scene}.csv", encoding="utf-8") as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


def size_of(folder, scene):
    return (folder / f"{scene}.box").read_text(encoding="utf-8").split()


def write_lammps_data(folder, scene, form):
    """The balls as LAMMPS (sphere) and LIGGGHTS (granular) read them; molecules name the clumps."""
    path = folder / f"{scene}.{'data' if form == 'lammps' else 'liggghts'}"
    if path.exists() and path.stat().st_mtime >= (folder / f"{scene}.csv").stat().st_mtime:
        return
    rows, size = balls_of(folder, scene), size_of(folder, scene)
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"{scene}\n\n{len(rows)} atoms\n1 atom types\n\n")
        for axis, length in zip("xyz", size):
            file.write(f"-0.01 {float(length) + 0.01} {axis}lo {axis}hi\n")
        file.write("\nAtoms\n\n" if form == "liggghts" else "\nAtoms # sphere\n\n")
        for number, row in enumerate(rows, 1):
            file.write(f"{number} 1 {2 * row['radius']!r} {DENSITY!r} {row['x']!r} {row['y']!r} {row['z']!r}\n")
        if scene == "clumps":
            file.write("\nMolecules\n\n")
            for number, row in enumerate(rows, 1):
                file.write(f"{number} {int(row['body']) + 1}\n")


def variables(**values):
    return [word for name, value in values.items() for word in ("-var", name, str(value))]


def run_dem4grm(folder, scene, steps, options, target):
    more = {"DEM4GRM_TARGET": target} if target else {}
    text = run([options.program, "run", ".", scene, steps], folder, f"{scene}.dem4grm.log", options.cores, **more)
    balls, touching, seconds = text.split()[-3:]
    return int(balls), int(touching), float(seconds)


def loop_times(text):
    pattern = r"Loop time of (\S+) on \d+ procs for \d+ steps with (\d+) atoms"
    return [(float(t), int(n)) for t, n in re.findall(pattern, text)]


def run_lammps(folder, scene, steps, options, law="same"):
    write_lammps_data(folder, scene, "lammps")
    x, y, z = size_of(folder, scene)
    kn = 4.0 / 3.0 * YOUNG / (2.0 * (1.0 - POISSON**2))
    kt = 8.0 * YOUNG / (4.0 * (2.0 - POISSON) * (1.0 + POISSON))
    kind = "clumps" if scene == "clumps" else "spheres"
    command = ["mpirun", "-np", options.cores, "lmp", "-in", HERE / "lammps.in", "-log", "none"]
    values = variables(scene=scene, kind=kind, law=law, young=YOUNG, poisson=POISSON, kn=kn, kt=kt, friction=FRICTION,
                       steps=steps, x=x, y=y, z=z)
    text = run(command + values, folder, f"{scene}.lammps-{law}.log", options.cores)
    seconds, balls = loop_times(text)[-1]
    touches = re.findall(r"^\s*\d+\s+(\d+)\s*$", text, re.MULTILINE)
    return balls, int(touches[-1]) // 2, seconds


def run_liggghts(folder, scene, steps, options):
    write_lammps_data(folder, scene, "liggghts")
    x, y, z = size_of(folder, scene)
    command = ["mpirun", "-np", options.cores, "liggghts", "-in", HERE / "liggghts.in", "-log", "none"]
    values = variables(scene=scene, young=YOUNG, poisson=POISSON, friction=FRICTION, steps=steps, x=x, y=y, z=z)
    text = run(command + values, folder, f"{scene}.liggghts.log", options.cores)
    seconds, balls = loop_times(text)[-1]
    return balls, 0, seconds


def run_yade(folder, scene, steps, options):
    command = ["yade", "-n", "-x", f"-j{options.cores}", HERE / "yade.py", ".", scene, steps, YOUNG, POISSON, FRICTION]
    text = run(command, folder, f"{scene}.yade.log", options.cores)
    balls, touching, seconds = re.search(r"RESULT (\d+) (\d+) (\S+)", text).groups()
    return int(balls), int(touching), float(seconds)


RUNNERS = {"lammps": run_lammps, "lammps-fast": functools.partial(run_lammps, law="fast"),
           "liggghts": run_liggghts, "yade": run_yade}
# What must be on the path for each of the others.
PROGRAMS = {"lammps": "lmp", "lammps-fast": "lmp", "liggghts": "liggghts", "yade": "yade"}


def report(speeds, ours):
    """speeds[scene][code]: one speed per round; ours: the codes that are DEM4GRM, one for each target."""
    print(f"\n{'scene':<16} {'code':<12} {'M ball-steps/s':>15}  " + "  ".join(f"{name} faster by (range)" for name in ours))
    for scene, codes in speeds.items():
        for code, values in codes.items():
            line = f"{scene:<16} {code:<12} {statistics.median(values):>15.2f}"
            for name in ours if code not in ours else ():
                ratios = [mine / theirs for mine, theirs in zip(codes[name], values)]
                line += f"  {statistics.median(ratios):>8.2f} ({min(ratios):.2f} to {max(ratios):.2f})"
            print(line)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--cores", type=int, default=2)
    parser.add_argument("--targets", default="", help="processor targets of DEM4GRM, with commas between them")
    parser.add_argument("--scene", action="append", choices=list(STEPS), help="default: all")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build/bench-peers")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/bench/bench/bench_peer_scenes")
    parser.add_argument("--install", action="store_true", help="install LAMMPS, LIGGGHTS and YADE first")
    options = parser.parse_args()
    if options.install:
        subprocess.run([str(ROOT / "tools/install_dependencies.sh"), "peers"], check=True)
    options.program = options.program.resolve()
    found = {code for code, program in PROGRAMS.items() if shutil.which(program)}
    if not found:
        print("skipped: none of LAMMPS, LIGGGHTS and YADE is installed; tools/install_dependencies.sh peers")
        return 77
    options.folder = options.folder.resolve()
    options.folder.mkdir(parents=True, exist_ok=True)
    if not (options.folder / "clusters-6000.csv").exists():
        run([options.program, "make", options.folder], options.folder, "make.log", options.cores)
    print("round,scene,code,cores,balls,touching_pairs,steps,seconds,million_ball_steps_per_second")
    ours = {f"dem4grm-{name}" if name else "dem4grm": functools.partial(run_dem4grm, target=name)
            for name in options.targets.split(",")}
    runners = {**ours, **{code: RUNNERS[code] for code in CODES[1:] if code in found}}
    speeds = {}
    for number in range(1, options.rounds + 1):
        for scene in options.scene or STEPS:
            for code, runner in runners.items():
                steps = STEPS[scene][0 if code in ours else CODES.index(code)]
                if steps == 0:
                    continue
                balls, touching, seconds = runner(options.folder, scene, steps, options)
                if balls != len(balls_of(options.folder, scene)):
                    raise RuntimeError(f"{code} has {balls} balls in scene {scene}: delete {options.folder} and try again")
                speed = balls * steps / seconds * 1e-6
                speeds.setdefault(scene, {}).setdefault(code, []).append(speed)
                print(f"{number},{scene},{code},{options.cores},{balls},{touching},{steps},{seconds:.3f},{speed:.3f}",
                      flush=True)
    report(speeds, list(ours))
    return 0


if __name__ == "__main__":
    sys.exit(main())
