#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the same scenes in DEM4GRM, LAMMPS and YADE and holds the results against each other.

  compare.py impact|cantilever|compression|all [--program PEER_CASES] [--folder FOLDER] [--picture FILE] [--install]

Exit codes: 0 all within tolerance, 1 something is not or a program failed, 77 skipped: the programs that this group
needs are not installed. Nothing is installed unless --install is given. docs/verification/independent-codes.md describes the scenes.
"""
import argparse
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys

import peer_programs
from peer_tables import Report

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
SKIPPED = 77

# Gross sliding without damping: tan(angle) > 3.5 friction (1 + 1), 32.8 degrees. There nothing depends on the shear
# stiffness.
SLIDING_FROM_DEG = 33

# Which normal force limits friction, and whether the normal dashpot may pull: as documented, and as found.
DAMPED_RULES = {"ours": ("elastic", True), "lammps": ("total", True), "yade": ("total", False)}


def read_parameters():
    with open(HERE / "parameters.json", encoding="utf-8") as file:
        return json.load(file)


def scaled_rebound(table, facts, section, speed):
    """Tangential speed, spin times radius, normal speed; over the speed of impact, one row for each angle."""
    rows, share = (table, 1.0) if facts["at_wall"] else (table[0::2], 2.0)
    radius = section["radius"]
    return [[share * row["vx"] / speed, share * radius * row["wy"] / speed, share * row["vz"] / speed] for row in rows]


def damped_shift(program, facts, section):
    """What the rules for the dashpot make of the difference between us and the other program (impact_model.py)."""
    from impact_model import rebound
    ours, theirs = (rebound(tuple(section["angles_deg"]), section["poisson"], section["friction"],
                            facts["damping_ratio"], *DAMPED_RULES[side]) for side in ("ours", program))
    return ours - theirs


def compare_impact(report, folder, parameters, programs):
    """Largest difference over the angles, separately where the contact sticks at some time and where it slides."""
    section = parameters["impact"]
    angles = section["angles_deg"]
    quantities = ("tangential speed", "spin x radius", "normal speed")
    for scene in sorted(folder.glob("impact-*.json")):
        name = scene.stem
        with open(scene, encoding="utf-8") as file:
            facts = json.load(file)
        speed = section["speeds"][0 if "-fast-" in name else 1]
        ours = scaled_rebound(peer_programs.read_table(folder / f"{name}.ours.csv"), facts, section, speed)
        for program in programs:
            if program == "yade" and facts["rule"] == "rescaled":
                continue  # YADE keeps the shear force when the normal force falls; it has no other rule
            theirs = scaled_rebound(programs[program].impact(folder, name, facts, section), facts, section, speed)
            difference = [[x - y for x, y in zip(a, b)] for a, b in zip(ours, theirs)]
            if facts["rule"] == "damped":
                shift = damped_shift(program, facts, section)
                for k, quantity in enumerate(quantities):
                    worst = max(abs(row[k]) for row in difference)
                    report.row(f"{name}: {quantity} / v, as it is", program, worst, 2e-2)
                difference = [[d - s for d, s in zip(a, b)] for a, b in zip(difference, shift)]
            for part, used in (("sticks", [a < SLIDING_FROM_DEG for a in angles]),
                               ("slides", [a >= SLIDING_FROM_DEG for a in angles])):
                limits = impact_limits(facts, part, "-fast-" in name)
                for k, quantity in enumerate(quantities):
                    worst = max(abs(row[k]) for row, u in zip(difference, used) if u)
                    report.row(f"{name}, {part}: {quantity} / v", program, worst, limits[k])


def impact_limits(facts, part, is_fast):
    """Limits for tangential speed, spin and normal speed over the speed of impact; the page says where they come from."""
    lever = 1e-3 if is_fast else 3e-5  # of the order of overlap over radius, 3.2e-3 and 8e-5
    if facts["rule"] == "damped":
        return lever + 3e-5, 2 * lever + 6e-5, 0.02 * lever + 6e-6
    if part == "slides":
        return 1e-12, lever if facts["at_wall"] else 1e-12, 1e-12
    return lever, 2 * lever, 1e-3 * lever


def compare_cantilever(report, folder, parameters, programs):
    """Largest difference of any displacement over the largest displacement; the same for the rotations."""
    if "yade" not in programs:
        report.note("cantilever: needs YADE; this LAMMPS has no bonds with moments")
        return
    programs["yade"].cantilevers(folder)
    section = parameters["cantilever"]
    for scene in sorted(folder.glob("cantilever-*.ours.csv")):
        name = scene.name.removesuffix(".ours.csv")
        ours, theirs = (peer_programs.read_table(folder / f"{name}.{side}.csv") for side in ("ours", "yade"))
        for quantity, columns in (("displacements", ("ux", "uy", "uz")), ("rotations", ("ax", "ay", "az"))):
            scale = max(abs(row[c]) for row in theirs for c in columns)
            difference = max(abs(a[c] - b[c]) for a, b in zip(ours, theirs) for c in columns)
            if scale * (section["radius"] if quantity == "rotations" else 1.0) < 1e-15:
                continue
            limit = 1e-7 if "grain" not in name else 1e-5 if "small" in name else 5e-3
            report.row(f"{name}: {quantity}", "yade", difference / scale, limit)
        if "grain" not in name:
            compare_closed_form(report, name, folder, section)


def compare_closed_form(report, name, folder, section):
    """Tip of the chain of N equal bonds, L = 2 r N, with the stiffnesses of the bond."""
    bonds, radius = int(name[-1]), section["radius"]
    modulus, ratio, length = section["modulus"], section["stiffness_ratio"], 2 * radius * bonds
    area = math.pi * radius**2
    inertia = area * radius**2 / 4
    start, tip = (peer_programs.read_table(folder / f"{name}.{side}.csv")[-1] for side in ("start", "ours"))
    force, torque, shift, turn = (math.hypot(*(row[c] for c in columns)) for row, columns in (
        (start, ("fx", "fy", "fz")), (start, ("tx", "ty", "tz")), (tip, ("ux", "uy", "uz")), (tip, ("ax", "ay", "az"))))
    expected, found = {
        "force": (force * length**3 / (3 * modulus * inertia) * (1 - 0.25 / bonds**2)
                  + ratio * force * length / (modulus * area), shift),
        "pull": (force * length / (modulus * area), shift),
        "twist": (ratio * torque * length / (2 * modulus * inertia), turn),
        "moment": (torque * length / (modulus * inertia), turn),
    }[name.split("-")[1]]
    report.row(f"{name}: tip", "formula", abs(found / expected - 1), 1e-6)


def compare_compression(report, folder, parameters, programs):
    """Forces on lid, floor and sides, relative; and the void ratio at given stresses on the lid."""
    section = parameters["compression"]
    for scene in sorted(folder.glob("compression-*.json")):
        name = scene.stem
        with open(scene, encoding="utf-8") as file:
            facts = json.load(file)
        curves = {"disturbed": peer_programs.read_table(folder / f"{name}.disturbed.csv")}
        for program in programs:
            if facts["rule"] == "damped" and program == "yade":
                continue  # its rules for the dashpot are seen in the impacts
            curves[program] = programs[program].compression(folder, name, facts, section)
        ours = peer_programs.read_table(folder / f"{name}.ours.csv")
        for program, curve in curves.items():
            compare_curves(report, name, program, ours, curve)
            for stress in (20e3, 60e3, 120e3):
                force = stress * facts["size"][0] * facts["size"][1]
                a, b = (void_ratio_at(force, c, facts) for c in (ours, curve))
                report.row(f"{name}: void ratio at {stress / 1e3:.0f} kPa, {a:.5f}", program, abs(a - b),
                           1e-3 if facts["rule"] == "damped" else 3e-4)


def compare_curves(report, name, program, ours, curve):
    """First the start, before small differences have grown; then all but the start, where forces are small."""
    start, later = range(len(ours) // 10), range(len(ours) // 10, len(ours))
    is_elastic = "elastic" in name
    for quantity, columns in (("lid", ("lid",)), ("floor", ("floor",)),
                              ("sides", ("x_low", "x_high", "y_low", "y_high"))):
        error = [sum(a[c] for c in columns) / sum(b[c] for c in columns) - 1.0 for a, b in zip(ours, curve)]
        if is_elastic:
            report.row(f"{name}: {quantity}, start", program, max(abs(error[k]) for k in start), 2e-3)
        report.row(f"{name}: {quantity}, largest", program, max(abs(error[k]) for k in later), 0.03 if is_elastic else 0.06)
        mean_square = sum(error[k] ** 2 for k in later) / len(later)
        report.row(f"{name}: {quantity}, root mean square", program, mean_square**0.5, 0.01 if is_elastic else 0.02)


def void_ratio_at(force, curve, facts):
    """Void ratio when the lid first carries the force, by linear interpolation."""
    length, width, height = facts["size"]
    before = {"displacement": 0.0, "lid": 0.0}
    for row in curve:
        if row["lid"] >= force:
            share = (force - before["lid"]) / (row["lid"] - before["lid"])
            down = before["displacement"] + share * (row["displacement"] - before["displacement"])
            return length * width * (height - down) / facts["solid_volume"] - 1.0
        before = row
    raise ValueError(f"the lid never carries {force} N")


COMPARISONS = {"impact": compare_impact, "cantilever": compare_cantilever, "compression": compare_compression}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("group", choices=[*COMPARISONS, "all"])
    parser.add_argument("--program", type=pathlib.Path, help="peer_cases; default: that of build/release",
                        default=ROOT / "build/release/tests/oracle/peers/peer_cases")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build/peers", help="for all files")
    parser.add_argument("--picture", type=pathlib.Path, help="draw the curves into this file (group all)")
    parser.add_argument("--install", action="store_true", help="install LAMMPS and YADE first")
    options = parser.parse_args()
    if options.install:
        subprocess.run([str(ROOT / "tools/install_dependencies.sh"), "peers"], check=True)
    programs = peer_programs.found()
    if not programs:
        print("skipped: neither LAMMPS (lmp) nor YADE (yade) is installed; tools/install_dependencies.sh peers")
        return SKIPPED
    for name in set(peer_programs.KNOWN) - set(programs):
        print(f"{name} is not installed: its comparisons are left out")
    os.environ.setdefault("OMP_NUM_THREADS", "1")

    parameters = read_parameters()
    report = Report()
    for group, compare in COMPARISONS.items():
        if options.group not in (group, "all"):
            continue
        folder = options.folder.resolve() / group
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        subprocess.run([str(options.program), group, str(HERE / "parameters.json"), str(folder)], check=True)
        compare(report, folder, parameters, programs)
    report.print()
    if options.picture:
        from peer_pictures import draw
        draw(options.folder.resolve(), parameters, options.picture)
    if report.is_empty():
        return SKIPPED
    return 0 if report.passed() else 1


if __name__ == "__main__":
    sys.exit(main())
