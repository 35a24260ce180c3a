#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws several direct shear runs side by side: `tools/compare_micro.py runs/a runs/b [-o picture.png] [--table]`.

All curves against shear displacement: stress, volume, anisotropies with their directions, friction, contacts, the strong
network by kind and the strain of the rubber. --table also prints, in Markdown, their values before shear, at the peak of the
shear stress and at the end. Reads shear.csv, micro.csv and summary.json. Needs python3-matplotlib.
"""
import argparse
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from run_files import read_csv, read_json

COLOURS = ("#31475e", "#c2410c", "#0e7490", "#7c3aed", "#b9a27f", "#4d7c0f")
KINDS = {"gg": "gravel-gravel", "gr": "gravel-rubber", "rr": "rubber-rubber"}

# Title, axis label, and columns of micro.csv with the style of each. Directions are points: they are known modulo 180 degrees,
# those of the tangential forces modulo 90, and a line would leap.
PANELS = (
    ("Fabric a (dotted: noise)", "", (("a_all", "-"), ("a_noise_all", ":"))),
    ("Normal force a_n", "", (("a_n_all", "-"),)),
    ("Tangential force a_t", "", (("a_t_all", "-"),)),
    ("Scatter about the curves: a_n (dashed: a_t)", "", (("a_n_residual_all", "-"), ("a_t_residual_all", "--"))),
    ("Direction of contacts theta_a", "degrees", (("theta_a_all_deg", "."),)),
    ("Direction of normal forces theta_n", "degrees", (("theta_n_all_deg", "."),)),
    ("Direction of tangential forces theta_t", "degrees", (("theta_t_all_deg", "."),)),
    ("q/p of the contacts (dashed: of fabric and forces)", "", (("stress_ratio", "-"), ("stress_ratio_of_fabric", "--"))),
    ("Bulk friction", "", (("bulk_friction_all", "-"),)),
    ("Sliding contacts (dashed: rattlers)", "share", (("sliding_all", "-"), ("rattlers", "--"))),
    ("Contacts of a grain (dashed: neighbours)", "", (("coordination", "-"), ("coordination_pairs", "--"))),
    ("Strain of the bonds (dashed: volume of the grains)", "", (("bond_strain", "-"), ("volume_strain", "--"))),
)


# Name and column of micro.csv of each row of the table.
ROWS = (("fabric a", "a_all"), ("its noise", "a_noise_all"), ("theta_a", "theta_a_all_deg"), ("a_n", "a_n_all"),
        ("theta_n", "theta_n_all_deg"), ("a_t", "a_t_all"), ("theta_t", "theta_t_all_deg"),
        ("bulk friction", "bulk_friction_all"), ("sliding contacts", "sliding_all"), ("coordination", "coordination"),
        ("rattlers", "rattlers"), ("strong contacts", "strong_fraction"), ("load of strong contacts", "strong_load"),
        ("strong g-g", "strong_share_gg"), ("strong g-r", "strong_share_gr"), ("strong r-r", "strong_share_rr"),
        ("load on strong g-g", "strong_load_share_gg"), ("load on strong g-r", "strong_load_share_gr"),
        ("load on strong r-r", "strong_load_share_rr"), ("strong network spans", "strong_spans"),
        ("bond strain", "bond_strain"), ("volume strain of grains", "volume_strain"),
        ("closed second neighbours", "closed_second_neighbours"))


class Run:
    def __init__(self, folder):
        self.shear = read_csv(folder / "shear.csv")
        self.micro = read_csv(folder / "micro.csv")
        summary = read_json(folder)
        self.displacement_at_peak = summary["displacement_at_peak_mm"]
        self.name = f"VRC {100 * summary['rubber_content']:.0f} %"
        self.label = (f"VRC {100 * summary['rubber_content']:.0f} %, {summary['normal_stress_target_kPa']:g} kPa, "
                      f"e {summary['void_ratio_before_shear']:.3f}")


def draw_curves(axes, runs):
    for run, colour in zip(runs, COLOURS):
        u = run.shear["displacement_mm"]
        axes[0].plot(u, run.shear["shear_stress_kPa"], color=colour, lw=0.9, label=run.label)
        axes[1].plot(u, run.shear["vertical_displacement_mm"], color=colour)
        axes[2].plot(run.micro["displacement_mm"], run.micro["stress_difference"], color=colour)
        axes[3].plot(u, run.shear["inertial_number"], color=colour, lw=0.9)
    axes[0].legend(fontsize=8, frameon=False)
    titles = ("Shear stress, kPa", "Vertical displacement (dilation positive), mm",
              "Contact against boundary stress, over sigma_n", "Inertial number")
    for axis, title in zip(axes, titles):
        axis.set_title(title, fontsize=9)


def draw_panels(axes, runs):
    for axis, (title, unit, columns) in zip(axes, PANELS):
        for run, colour in zip(runs, COLOURS):
            for name, style in columns:
                axis.plot(run.micro["displacement_mm"], run.micro[name], style, color=colour, lw=1.1, ms=3)
        axis.set_title(title, fontsize=9)
        axis.set_ylabel(unit, fontsize=8)


def draw_strong(axes, runs):
    """By number in the first panels, by load in the last: full lines g-g, dashed g-r, dotted r-r."""
    for axis, (column, title) in zip(axes, (("strong_share", "Strong contacts by number"),
                                            ("strong_load_share", "Strong contacts by load"))):
        for run, colour in zip(runs, COLOURS):
            for kind, style in zip(KINDS, ("-", "--", ":")):
                axis.plot(run.micro["displacement_mm"], run.micro[f"{column}_{kind}"], style, color=colour, lw=1.1)
        axis.set(ylim=(-0.02, 1.02))
        axis.set_title(f"{title} (line g-g, dashed g-r, dotted r-r)", fontsize=9)
    for run, colour in zip(runs, COLOURS):
        axes[2].plot(run.micro["displacement_mm"], run.micro["strong_fraction"], color=colour)
        axes[2].plot(run.micro["displacement_mm"], run.micro["strong_load"], "--", color=colour)
        axes[3].plot(run.micro["displacement_mm"], run.micro["closed_second_neighbours"], color=colour)
    axes[2].set_title("Share of strong contacts (dashed: of the load)", fontsize=9)
    axes[3].set_title("Closed second neighbours in a rubber grain", fontsize=9)


def table(runs):
    """Markdown: a row a quantity; of each run the values before shear, nearest to the peak and at the end."""
    lines = ["| | " + " | ".join(f"{r.name}: start, peak, end" for r in runs) + " |", "| --- |" + " --- |" * len(runs)]
    for name, column in ROWS:
        cells = []
        for run in runs:
            peak = np.argmin(np.abs(run.micro["displacement_mm"] - run.displacement_at_peak))
            values = [run.micro[column][k] for k in (0, peak, -1)]
            cells.append("-" if np.isnan(values).all() else ", ".join(f"{v:.3g}" for v in values))
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folders", type=pathlib.Path, nargs="+", help="output folders of finished direct shear runs")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("comparison.png"))
    parser.add_argument("--table", action="store_true", help="print a Markdown table, too")
    options = parser.parse_args()
    for folder in options.folders:
        missing = [n for n in ("shear.csv", "micro.csv", "summary.json") if not (folder / n).exists()]
        if missing:
            print(f"{folder}: has no {', '.join(missing)}; it is no finished direct shear run", file=sys.stderr)
            return 66
    if len(options.folders) > len(COLOURS):
        print(f"at most {len(COLOURS)} runs can be told apart", file=sys.stderr)
        return 64
    runs = [Run(folder) for folder in options.folders]
    figure, axes = plt.subplots(5, 4, figsize=(17, 17), layout="constrained")
    draw_curves(axes[0], runs)
    draw_panels(axes[1:4].flat, runs)
    draw_strong(axes[4], runs)
    for axis in axes.flat:
        axis.tick_params(labelsize=8)
        axis.set_xlim(left=0)
    for axis in axes[4]:
        axis.set_xlabel("shear displacement, mm", fontsize=8)
    figure.savefig(options.output, dpi=100)
    print(options.output)
    if options.table:
        print(table(runs))
    return 0


if __name__ == "__main__":
    sys.exit(main())
