#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Who carries the load: `strong_network.py FOLDER [--at 8] [-o strong.png]`.

Strong contacts (more than the mean normal force) of a state as lines between the centres of the grains, seen along y, and their shares by kind
against displacement.
"""
import argparse

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.patches import Rectangle

import test_folder as test
from test_folder import plt


def draw_chains(axes, arrays, at):
    contacts, centre = test.contacts_between_grains(arrays), test.body_centres(arrays) * 1e3
    force = contacts["normal_force"]
    is_strong = force > force.mean()
    for kind, (name, colour) in enumerate(zip(test.KINDS, test.COLOURS)):
        rows = is_strong & (contacts["kind"] == kind)
        ends = np.stack([centre[contacts["body_i"][rows]], centre[contacts["body_j"][rows]]], axis=1)[:, :, [0, 2]]
        widths = 4 * force[rows] / force.max() + 0.2
        if rows.any():  # matplotlib minds a collection of nothing
            axes.add_collection(LineCollection(ends, colors=colour, linewidths=widths, label=name))
        print(f"{at:.2f} mm, {name}: {rows.sum()} of {is_strong.sum()} strong contacts")
    walls = arrays["walls"]
    for name, corner, u, v, (a, b) in zip(walls["name"], walls["corner"], walls["u"], walls["v"], walls["lengths"]):
        if abs(u[1]) + abs(v[1]) < 1e-9 and b"wall" in name:  # walls that face along y are seen as rectangles
            far = (corner + a * u + b * v) * 1e3
            low, high = np.minimum(corner * 1e3, far), np.maximum(corner * 1e3, far)
            axes.add_patch(Rectangle(low[[0, 2]], *(high - low)[[0, 2]], fill=False, ec="0.5", lw=0.8))
    axes.set(xlabel="x, mm", ylabel="z, mm", title=f"strong contacts at {at:.2f} mm", aspect="equal")
    axes.autoscale()
    axes.legend(fontsize=8, frameon=False, loc="upper left")


def draw_shares(axes, rows):
    shares = [np.nan_to_num(rows[f"strong_share_{kind}"]) for kind in ("gg", "gr", "rr")]
    axes.stackplot(rows["displacement_mm"], *shares, colors=test.COLOURS, labels=test.KINDS, alpha=0.85)
    axes.axhline(0.5, color="white", lw=1, ls="--")  # the kind that holds more than half gives the zone its name
    axes.set(xlabel="shear displacement, mm", ylabel="share of the strong contacts", ylim=(0, 1))
    axes.set_xlim(0, rows["displacement_mm"].max())


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", help="output folder of a direct shear test")
    parser.add_argument("--at", type=float, default=8, metavar="MM", help="the nearest stored state is drawn")
    parser.add_argument("-o", "--output", default="strong.png")
    options = parser.parse_args()
    figure, (left, right) = plt.subplots(1, 2, figsize=(12, 5), layout="constrained", width_ratios=(3, 2))
    draw_chains(left, *test.state(options.folder, options.at))
    draw_shares(right, test.table(options.folder, "micro"))
    test.save(figure, options.output)


if __name__ == "__main__":
    main()
