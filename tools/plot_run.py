#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a finished run: `tools/plot_run.py runs/quick [-o picture.png] [--at 8]`.

A direct shear test becomes one sheet: shear stress and dilation against displacement, a cut through the specimen along the
shear direction, and the contact forces in the same slice. A grain compression becomes load, Poisson's ratio and the grain
from the side. Needs python3-h5py and python3-matplotlib; reads shear.csv or grain.csv and results.h5 only.
"""
import argparse
import pathlib
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection

from run_files import read_csv, read_json

GRAVEL, RUBBER = "#b9a27f", "#31475e"
PAIR_COLOURS = {"gravel-gravel": "#c2410c", "gravel-rubber": "#7c3aed", "rubber-rubber": "#0e7490"}


def nearest_frame(results, displacement_mm):
    frames = results["frames"]
    return min((frames[k] for k in frames), key=lambda f: abs(f.attrs["displacement"] * 1e3 - displacement_mm))


def circles(axes, x, z, radius, colour, **style):
    """Circles in data units, mm."""
    axes.add_collection(EllipseCollection(2 * radius, 2 * radius, np.zeros_like(radius), units="xy", offsets=np.c_[x, z],
                                          offset_transform=axes.transData, facecolors=colour, **style))


def draw_walls(axes, frame):
    corner, u, v, lengths = (frame["walls"][k][:] for k in ("corner", "u", "v", "lengths"))
    for c, a, b, (la, lb) in zip(corner, u, v, lengths):
        ends = np.array([c, c + a * la, c + b * lb, c + a * la + b * lb]) * 1e3
        if np.ptp(ends[:, 1]) < 1e-6:
            continue  # a wall parallel to the picture
        axes.plot([ends[:, 0].min(), ends[:, 0].max()], [ends[:, 2].min(), ends[:, 2].max()], color="black", lw=1.6)


def frame_axes(axes, frame, title):
    draw_walls(axes, frame)
    axes.set_aspect("equal")
    axes.autoscale_view()
    plate = frame["walls/corner"][list(frame["walls/name"].asstr()).index("top plate")] * 1e3
    axes.set_ylim(-3, plate[2] + 8)
    axes.set_xlabel("x, mm")
    axes.set_ylabel("z, mm")
    axes.set_title(title, fontsize=10, loc="left")


def draw_cut(axes, frame):
    """Every ball that the plane at mid-width cuts, as the circle of the cut."""
    position, radius = frame["balls/position"][:] * 1e3, frame["balls/radius"][:] * 1e3
    rubber = frame["balls/material"][:] == 1
    middle = 0.5 * (position[:, 1].min() + position[:, 1].max())
    off = np.abs(position[:, 1] - middle)
    hit = off < radius
    cut = np.sqrt(np.maximum(radius**2 - off**2, 0.0))
    for mask, colour in ((hit & ~rubber, GRAVEL), (hit & rubber, RUBBER)):
        circles(axes, position[mask, 0], position[mask, 2], cut[mask], colour, linewidths=0)
    frame_axes(axes, frame, "cut at mid-width: gravel (sand), rubber (blue)")


def draw_forces(axes, frame):
    """Contact forces between grains as lines through the contact points, width by force."""
    contacts = frame["contacts"]
    between = contacts["wall"][:] < 0
    kind = frame["balls/material"][:]
    point = contacts["point"][:][between] * 1e3
    normal, force = contacts["normal"][:][between], contacts["normal_force"][:][between]
    i, j = contacts["ball_i"][:][between], contacts["ball_j"][:][between]
    rubber = (kind[i] == 1).astype(int) + (kind[j] == 1).astype(int)
    mean = force.mean()
    order = np.argsort(force)
    for name, count in zip(PAIR_COLOURS, (0, 1, 2)):
        k = order[rubber[order] == count]
        ends = normal[k] * 1.6
        lines = np.stack([(point[k] - ends)[:, [0, 2]], (point[k] + ends)[:, [0, 2]]], axis=1)
        axes.add_collection(LineCollection(lines, linewidths=0.35 * np.minimum(force[k] / mean, 12),
                                           colors=PAIR_COLOURS[name], alpha=0.55))
        axes.plot([], [], color=PAIR_COLOURS[name], lw=2, label=f"{name}, {len(k)}")
    axes.legend(fontsize=7, loc="upper left", frameon=False, ncols=3)
    frame_axes(axes, frame, f"contact forces, mean {mean:.2f} N")


def draw_shear(folder, at):
    rows = read_csv(folder / "shear.csv")
    summary = read_json(folder)
    figure, axes = plt.subplots(2, 2, figsize=(11, 8.4), layout="constrained",
                                height_ratios=(1, 1.35))
    u = rows["displacement_mm"]
    axes[0, 0].plot(u, rows["shear_stress_kPa"], color=RUBBER, lw=1)
    if summary["peak_shear_stress_kPa"] is not None:  # else the record is shorter than 0.1 mm
        axes[0, 0].axhline(summary["peak_shear_stress_kPa"], color="grey", lw=0.6, ls="--")
    axes[0, 0].set(xlabel="shear displacement, mm", ylabel="shear stress, kPa", xlim=(0, u[-1]))
    axes[0, 0].set_title(f"{summary['case']}: rubber {100 * summary['rubber_content']:.1f} %, normal stress "
                         f"{summary['normal_stress_mean_kPa']:.1f} kPa", fontsize=10, loc="left")
    axes[0, 1].plot(u, rows["vertical_displacement_mm"], color=RUBBER, lw=1)
    axes[0, 1].set(xlabel="shear displacement, mm", ylabel="vertical displacement, mm", xlim=(0, u[-1]))
    axes[0, 1].set_title("dilation positive", fontsize=10, loc="left")
    with h5py.File(folder / "results.h5") as results:
        frame = nearest_frame(results, at)
        draw_cut(axes[1, 0], frame)
        draw_forces(axes[1, 1], frame)
        figure.suptitle(f"state at {frame.attrs['displacement'] * 1e3:.1f} mm below", fontsize=9, x=0.99, ha="right")
    return figure


def draw_compression(folder):
    rows = read_csv(folder / "grain.csv")
    figure, axes = plt.subplots(1, 4, figsize=(13, 3.6), layout="constrained")
    strain = 100 * rows["strain"]
    axes[0].plot(rows["displacement_mm"], rows["load_N"], color=RUBBER)
    axes[0].set(xlabel="approach of the plates, mm", ylabel="load, N")
    axes[1].plot(strain, rows["poisson_ratio"], color=RUBBER)
    axes[1].set(xlabel="strain, %", ylabel="Poisson's ratio of the inner cube", ylim=(0, 0.6))
    twin = axes[1].twinx()
    twin.plot(strain, rows["closed_second_neighbours"], color=GRAVEL, drawstyle="steps-post")
    twin.set_ylabel("second neighbours in contact (of 66)", color=GRAVEL)
    with h5py.File(folder / "results.h5") as results:
        frames = [results["frames"][k] for k in sorted(results["frames"])]
        for panel, frame, title in zip(axes[2:], (frames[0], frames[-1]), ("at rest", f"at {strain[-1]:.0f} %")):
            position, radius = frame["balls/position"][:] * 1e3, frame["balls/radius"][:] * 1e3
            for k in np.argsort(-position[:, 1]):  # the nearest last
                shade = plt.get_cmap("bone")(0.35 + 0.5 * (position[k, 1].max() - position[:, 1].min()) /
                                             np.ptp(position[:, 1]))
                panel.add_patch(plt.Circle(position[k, [0, 2]], radius[k], facecolor=shade, edgecolor="black", lw=0.4))
            for z in frame["walls/corner"][:, 2] * 1e3:
                panel.axhline(z, color="black", lw=1.6)
            panel.set(aspect="equal", xlim=(-3.2, 3.2), ylim=(-2.4, 2.4), xlabel="x, mm", ylabel="z, mm", title=title)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, help="output folder of a finished run")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="picture to write (default: FOLDER/run.png)")
    parser.add_argument("--at", type=float, default=8.0, help="displacement of the drawn state, mm")
    options = parser.parse_args()
    if read_json(options.folder) is None:
        print(f"{options.folder}: no summary.json, so the run is not finished; the same dem4grm command goes on", file=sys.stderr)
        return 66
    is_shear = (options.folder / "shear.csv").exists()
    figure = draw_shear(options.folder, options.at) if is_shear else draw_compression(options.folder)
    target = options.output or options.folder / "run.png"
    figure.savefig(target, dpi=110)
    print(target)
    return 0


if __name__ == "__main__":
    sys.exit(main())
