# SPDX-License-Identifier: BSD-3-Clause
"""Draws the impact and compression curves of all programs, and their differences, from the files of a comparison."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from peer_programs import read_table

STYLES = {"lammps": ("LAMMPS", "o", "#c0392b"), "yade": ("YADE", "x", "#2471a3")}


def rebound_ratio(folder, name, side, angles, speed):
    """Tangential speed after over before the impact of a sphere on a plane; None without that program."""
    path = folder / f"{name}.{side}.csv"
    if not path.exists():
        return None
    return [row["vx"] / (speed * math.sin(math.radians(angle))) for row, angle in zip(read_table(path), angles)]


def draw_impacts(above, below, folder, section):
    angles, speed = section["angles_deg"], section["speeds"][0]
    for rule, label, line in (("kept", "shear force kept", "-"), ("rescaled", "shear force rescaled", "--")):
        name = f"impact-wall-fast-{rule}"
        ours = rebound_ratio(folder, name, "ours", angles, speed)
        above.plot(angles, ours, line, color="black", label=f"DEM4GRM, {label}")
        for side, (title, marker, colour) in STYLES.items():
            theirs = rebound_ratio(folder, name, side, angles, speed)
            if theirs is None:
                continue
            above.plot(angles, theirs, marker, color=colour, fillstyle="none",
                       label=title if rule == "kept" else None)
            below.plot(angles, [a - b for a, b in zip(ours, theirs)], line, marker=marker, color=colour,
                       fillstyle="none", label=f"{title}, {rule}")
    above.set_title("Impact of a sphere on a plane, 3.9 m/s")
    above.set_ylabel("tangential speed after / before")
    above.legend()
    below.set_xlabel("angle of impact from the normal, degrees")
    below.set_ylabel("DEM4GRM - other")
    below.ticklabel_format(axis="y", style="sci", scilimits=(0, 0))
    below.legend()


def draw_compression(above, below, folder):
    name = "compression-elastic"
    ours = read_table(folder / f"{name}.ours.csv")
    path = [1e3 * row["displacement"] for row in ours]
    above.plot(path, [row["lid"] for row in ours], color="black", label="DEM4GRM")
    disturbed = read_table(folder / f"{name}.disturbed.csv")
    below.plot(path, [100 * (b["lid"] / a["lid"] - 1) for a, b in zip(ours, disturbed)], color="grey",
               label="DEM4GRM, spheres moved by 1 nm")
    for side, (title, marker, colour) in STYLES.items():
        table = folder / f"{name}.{side}.csv"
        if not table.exists():
            continue
        theirs = read_table(table)
        above.plot(path[::3], [row["lid"] for row in theirs][::3], marker, color=colour, fillstyle="none", label=title)
        below.plot(path, [100 * (b["lid"] / a["lid"] - 1) for a, b in zip(ours, theirs)], marker=marker, markersize=3,
                   linewidth=0.8, color=colour, fillstyle="none", label=title)
    above.set_title("Compression of 1,000 spheres")
    above.set_ylabel("force on the lid, N")
    above.legend()
    below.set_xlabel("displacement of the lid, mm")
    below.set_ylabel("difference in force, %")
    below.axhline(0.0, color="black", linewidth=0.5)
    below.set_ylim(bottom=-2.8)  # room for the legend
    below.legend()


def draw(folder, parameters, path):
    figure, axes = plt.subplots(2, 2, figsize=(11, 7), height_ratios=(2, 1), sharex="col", constrained_layout=True)
    draw_impacts(axes[0][0], axes[1][0], folder / "impact", parameters["impact"])
    draw_compression(axes[0][1], axes[1][1], folder / "compression")
    for axis in axes.flat:
        axis.grid(alpha=0.3)
        legend = axis.get_legend()
        for text in legend.get_texts() if legend else ():
            text.set_fontsize(8)
    figure.savefig(path, dpi=110)
