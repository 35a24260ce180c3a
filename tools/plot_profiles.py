#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a sheared specimen over its height: `tools/plot_profiles.py runs/quick [-o picture.png]`.

Mean displacement along the shear direction, rotation, void ratio and the share of strong contacts of each layer at each stored
state, from profiles.csv; the shear band of the last state, from summary.json, in grey with its standard error. Of an unfinished test
or an older folder the table is made by `dem4grm profile DIR --csv DIR/profiles.csv`. Needs python3-matplotlib.
"""
import argparse
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from run_files import read_csv, read_json

PANELS = (("displacement_x_mm", "displacement along the shear direction, mm"), ("rotation_deg", "rotation about y, degrees"),
          ("void_ratio", "void ratio"), ("strong_share", "share of strong contacts"))


def draw_band(axes, bands):
    """Grey from border to border of the last band that there is; lines at the borders plus and minus their errors."""
    known = [b for b in bands if b["thickness_mm"] is not None]
    if not known:
        return
    band = known[-1]
    low, high = (band["centre_mm"] + sign * band["thickness_mm"] / 2 for sign in (-1, 1))
    error = np.hypot(band["centre_error_mm"], band["thickness_error_mm"] / 2)
    axes.axhspan(low, high, color="0.9", zorder=0)
    for border in (low, high):
        axes.axhspan(border - error, border + error, color="0.8", zorder=0)


def draw(figure, rows, bands):
    states = np.unique(rows["shear_displacement_mm"])
    colours = plt.get_cmap("viridis")(np.linspace(0.0, 0.9, len(states)))
    all_axes = figure.subplots(1, len(PANELS), sharey=True)
    for axes, (name, label) in zip(all_axes, PANELS):
        draw_band(axes, bands)
        for state, colour in zip(states, colours):
            chosen = rows["shear_displacement_mm"] == state
            height = 0.5 * (rows["low_mm"] + rows["high_mm"])[chosen]
            axes.plot(rows[name][chosen], height, color=colour, marker=".", lw=1.2, label=f"{state:.2f} mm")
        axes.set_xlabel(label)
    all_axes[0].set_ylabel("height, mm")
    all_axes[0].set_ylim(0, rows["high_mm"].max())
    all_axes[-1].legend(title="shear", fontsize=7, frameon=False)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, help="output folder of a direct shear run")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="picture to write (default: FOLDER/profiles.png)")
    options = parser.parse_args()
    table = options.folder / "profiles.csv"
    if not table.exists():
        print(f"{table}: no such file; dem4grm profile {options.folder} --csv {table} makes it", file=sys.stderr)
        return 66
    figure = plt.figure(figsize=(12, 4.5), layout="constrained")
    draw(figure, read_csv(table), (read_json(options.folder) or {}).get("shear_band", []))
    target = options.output or options.folder / "profiles.png"
    figure.savefig(target, dpi=110)
    print(target)
    return 0


if __name__ == "__main__":
    sys.exit(main())
