#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures what the open choices of the rubber grain do: `tools/rubber_grain_study.py build/release/apps/dem4grm/dem4grm`.

Compresses one grain between two plates (cases/grain_compression.toml) for every variant, draws the curves into
docs/pictures/ and writes the tables between the marks of docs/verification/rubber-grain.md. Needs python3-matplotlib.
"""
import argparse
import pathlib
import subprocess
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from run_files import read_csv, read_json

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/verification/rubber-grain.md"
PICTURES = ROOT / "docs/pictures"
KAPPAS = (1, 2, 3, 4, 5, 6, 8)
COLOURS = ("#31475e", "#c2410c", "#0e7490", "#7c3aed", "#b9a27f")

SMOOTH = {"walls.friction": "0"}
ROUGH = {"walls.friction": "0.7", "rubber.friction": "0.7"}
NO_SPRING = {"rubber.bond.linear_spring": "false"}
SPRING_FRICTION = {"rubber.bond.spring_friction": "0.27"}
NO_SLIP = {"rubber.bond.spring_friction": "5"}
HERTZ_BESIDE = {"rubber.bond.hertz_contact": "true"}
INCREMENTAL = {"rubber.bond.form": "incremental"}
NO_MOMENTS = {"rubber.bond.moment_scale": "0", **INCREMENTAL}


def kappa(value):
    return {"rubber.bond.stiffness_ratio": str(float(value))}


def moments(value):
    return {"rubber.bond.moment_scale": str(value)}


class Grain:
    """Runs variants of the case and remembers them."""

    def __init__(self, program, folder):
        self.program, self.folder, self.done = program, pathlib.Path(folder), {}

    def run(self, settings=None, strain=0.45):
        settings = {"compression.strain": str(strain), **(settings or {})}
        key = tuple(sorted(settings.items()))
        if key not in self.done:
            output = self.folder / str(len(self.done))
            command = [self.program, "run", ROOT / "cases/grain_compression.toml", "-q", "-j", "1", "-o", output]
            for name, value in settings.items():
                command += ["--set", f"{name}={value}"]
            result = subprocess.run(command, capture_output=True, text=True)
            # A variant that breaks up stops with an error; its record up to there still counts.
            self.done[key] = Curve(output, result.returncode)
            print(settings, "" if result.returncode == 0 else result.stderr.strip(), flush=True)
        return self.done[key]


class Curve:
    def __init__(self, folder, status):
        self.columns = read_csv(folder / "grain.csv")
        # A load is a mean over its interval, so it belongs to the middle of it.
        u = self.columns["displacement_mm"]
        self.middle = u - 0.5 * np.diff(u, prepend=0.0)
        self.load, self.ratio, self.strain = (self.columns[k] for k in ("load_N", "poisson_ratio", "strain"))
        self.is_whole = status == 0
        self.summary = read_json(folder) if self.is_whole else {}

    def load_at(self, displacement_mm):
        return float(np.interp(displacement_mm, self.middle, self.load, right=np.nan))

    def ratio_at(self, strain):
        return float(np.interp(strain, self.strain, self.ratio, right=np.nan))

    def early_ratio(self):
        chosen = (self.strain >= 0.02) & (self.strain <= 0.08)
        return float(self.ratio[chosen].mean())

    def slope(self, low, high):
        """N/mm between two strains."""
        chosen = (self.strain >= low) & (self.strain <= high)
        return float(np.polyfit(self.middle[chosen], self.load[chosen], 1)[0]) if chosen.sum() > 2 else np.nan

    def knee(self):
        closed = self.columns["closed_second_neighbours"] > 0
        return float(self.strain[closed][0]) if closed.any() else np.nan


def number(value, digits):
    return "-" if np.isnan(value) else f"{value:.{digits}f}"


def table_of_kappa(grain):
    heads = ["linear springs, smooth plates", "linear springs, friction 0.27", "no linear springs, smooth plates",
             "no linear springs, friction 0.27", "no moments, no linear springs, smooth plates"]
    lines = ["| kappa | " + " | ".join(heads) + " | load at 0.41 mm | at 1.03 mm | time step |",
             "| --- " * (len(heads) + 4) + "|"]
    for k in KAPPAS:
        curves = ratio_curves(grain, k)
        shipped = grain.run(kappa(k))
        lines.append(f"| {k} | " + " | ".join(number(c.early_ratio(), 3) for c in curves) +
                     f" | {number(shipped.load_at(0.41), 2)} N | {number(shipped.load_at(1.03), 1)} N"
                     f" | {shipped.summary['time_step_s'] * 1e6:.2f} us |")
    return lines


def ratio_curves(grain, k):
    return [grain.run({**kappa(k), **SMOOTH}), grain.run(kappa(k)), grain.run({**kappa(k), **NO_SPRING, **SMOOTH}),
            grain.run({**kappa(k), **NO_SPRING}), grain.run({**kappa(k), **NO_MOMENTS, **NO_SPRING, **SMOOTH}, 0.12)]


VARIANTS = [
    ("**as shipped**", {}),
    ("incremental bonds", INCREMENTAL),
    ("rubber's Poisson's ratio 0.3", {"rubber.poisson_ratio": "0.3"}),
    ("rubber's Poisson's ratio 0", {"rubber.poisson_ratio": "0"}),
    ("moment scale 0.5", moments(0.5)),
    ("moment scale 0.25", moments(0.25)),
    ("moment scale 0.1", moments(0.1)),
    ("no moments (incremental bonds)", NO_MOMENTS),
    ("no moments, plates ten times slower", {**NO_MOMENTS, "compression.plate_velocity": "2 mm/s"}),
    ("no moments, no linear springs, smooth plates", {**NO_MOMENTS, **NO_SPRING, **SMOOTH}),
    ("the same, plates ten times slower", {**NO_MOMENTS, **NO_SPRING, **SMOOTH, "compression.plate_velocity": "2 mm/s"}),
    ("bond radius 0.5 r", {"rubber.bond.radius_multiplier": "0.5"}),
    ("no linear springs", NO_SPRING),
    ("linear springs with friction 0.27", SPRING_FRICTION),
    ("linear springs with friction 0.27, smooth plates", {**SPRING_FRICTION, **SMOOTH}),
    ("linear springs that do not slip, smooth plates", {**NO_SLIP, **SMOOTH}),
    ("Hertz contact in bonded pairs, no linear springs", {**HERTZ_BESIDE, **NO_SPRING}),
    ("the same, smooth plates", {**HERTZ_BESIDE, **NO_SPRING, **SMOOTH}),
    ("Hertz contact in bonded pairs, linear springs", HERTZ_BESIDE),
    ("damping ratio 0", {"rubber.bond.damping_ratio": "0"}),
    ("damping ratio 0.5", {"rubber.bond.damping_ratio": "0.5"}),
    ("local damping 0.7", {"integration.local_damping": "0.7"}),
    ("smooth plates", SMOOTH),
    ("friction 0.1 at the plates", {"walls.friction": "0.1"}),
    ("friction 0.7 everywhere", ROUGH),
    ("plates five times slower", {"compression.plate_velocity": "4 mm/s"}),
    ("time step halved", {"integration.time_step_safety": "0.4"}),
]


def table_of_variants(grain):
    lines = ["| variant | load at 0.41 mm | at 1.03 mm | at 1.65 mm | slope 2-8 % | slope 34-44 % | knee | Poisson's ratio 2-8 % | at 30 % |",
             "| --- " * 9 + "|"]
    for name, settings in VARIANTS:
        c = grain.run(settings)
        lines.append(f"| {name} | {number(c.load_at(0.41), 2)} N | {number(c.load_at(1.03), 1)} N | {number(c.load_at(1.65), 1)} N"
                     f" | {number(c.slope(0.02, 0.08), 1)} | {number(c.slope(0.34, 0.44), 1)} | {number(100 * c.knee(), 1)} %"
                     f" | {number(c.early_ratio(), 3)} | {number(c.ratio_at(0.3), 2)} |")
    return lines


def table_of_forms(grain):
    points = (0.20, 0.41, 0.61, 0.82, 1.03, 1.23, 1.65, 1.85)
    separate = dict(zip(points, ("2.93", "6.57", "11.1", "18.9", "28.7", "39.8", "64.5", "77")))
    lines = ["| approach, mm | " + " | ".join(f"{p:.2f}" for p in points) + " |", "| --- " * (len(points) + 1) + "|"]
    for name, settings in (("history-free bonds, N", {}), ("incremental bonds, N", INCREMENTAL), ("smooth plates, N", SMOOTH)):
        lines.append(f"| {name} | " + " | ".join(f"{grain.run(settings).load_at(p):.3g}" for p in points) + " |")
    lines.append("| separate single-grain program, N | " + " | ".join(separate[p] for p in points) + " |")
    return lines


def draw_kappa(grain):
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.2), layout="constrained")
    labels = ("springs, smooth plates", "springs, friction 0.27 (shipped at 4)", "no springs, smooth plates",
              "no springs, friction 0.27", "no springs, no moments, smooth plates")
    table = np.array([[c.early_ratio() for c in ratio_curves(grain, k)] for k in KAPPAS])
    for label, column, colour in zip(labels, table.T, COLOURS):
        left.plot(KAPPAS, column, "o-", color=colour, label=label, ms=4)
    fine = np.linspace(1, 8, 200)
    left.plot(fine, (fine - 1) / (2 * fine + 1), color="black", lw=0.8, ls="--", label="infinite lattice, (k-1)/(2k+1)")
    left.axhline(0.5, color="black", lw=0.5)
    left.set(xlabel="normal over shear stiffness of a bond", ylabel="Poisson's ratio of the inner cube, 2 to 8 %")
    left.legend(fontsize=8)
    for k, colour in zip((1, 2, 4, 8), COLOURS):
        c = grain.run(kappa(k))
        right.plot(c.middle, c.load, color=colour, label=f"kappa = {k}")
    right.set(title="linear springs, friction 0.27", xlabel="approach of the plates, mm", ylabel="load, N", xlim=(0, None), ylim=(0, None))
    right.legend(fontsize=8)
    figure.savefig(PICTURES / "rubber-grain-kappa.png", dpi=110)


PANELS = [
    ("rubber's Poisson's ratio (Hertz)", [("0.5 (shipped)", {}), ("0.3", {"rubber.poisson_ratio": "0.3"}),
                                          ("0", {"rubber.poisson_ratio": "0"})]),
    ("bond moments", [("on (shipped)", {}), ("scale 0.5", moments(0.5)), ("scale 0.1", moments(0.1)), ("off", NO_MOMENTS),
                      ("off, ten times slower", {**NO_MOMENTS, "compression.plate_velocity": "2 mm/s"})]),
    ("beside the bond", [("linear spring (shipped)", {}), ("nothing", NO_SPRING),
                         ("spring with friction 0.27", SPRING_FRICTION),
                         ("Hertz contact, no spring", {**HERTZ_BESIDE, **NO_SPRING}),
                         ("spring, bond radius 0.5 r", {"rubber.bond.radius_multiplier": "0.5"})]),
    ("friction at the plates", [("0.27 (shipped)", {}), ("0", SMOOTH), ("0.1", {"walls.friction": "0.1"}),
                                ("0.7 everywhere", ROUGH)]),
]


def draw_variants(grain):
    figure, axes = plt.subplots(2, 4, figsize=(14, 7), layout="constrained", sharex="row", sharey="row")
    for (title, lines), upper, lower in zip(PANELS, axes[0], axes[1]):
        for (label, settings), colour in zip(lines, COLOURS):
            c = grain.run(settings)
            upper.plot(c.middle, c.load, color=colour, label=label)
            lower.plot(100 * c.strain, c.ratio, color=colour)
        upper.set_title(title, fontsize=10, loc="left")
        upper.set(xlabel="approach of the plates, mm", xlim=(0, 1.9), ylim=(0, 85))
        upper.legend(fontsize=8)
        lower.set(xlabel="strain, %", xlim=(0, 45), ylim=(0, 0.8))
    axes[0, 0].set_ylabel("load, N")
    axes[1, 0].set_ylabel("Poisson's ratio of the inner cube")
    figure.savefig(PICTURES / "rubber-grain-variants.png", dpi=110)


def replace_table(name, lines):
    text = PAGE.read_text()
    first, last = f"<!-- table {name} -->\n", "<!-- end of table -->"
    start = text.index(first) + len(first)
    PAGE.write_text(text[:start] + "\n".join(lines) + "\n" + text[text.index(last, start):])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path, help="dem4grm")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        grain = Grain(options.program.resolve(), folder)
        for name, make in (("kappa", table_of_kappa), ("variants", table_of_variants), ("forms", table_of_forms)):
            replace_table(name, make(grain))
        draw_kappa(grain)
        draw_variants(grain)


if __name__ == "__main__":
    main()
