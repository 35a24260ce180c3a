#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a collected study: `tools/plot_campaign.py runs/quick-study/collected [-o picture.png]`.

One column for each normal stress with shear stress and vertical displacement of every test, coloured by mixture, and a panel with
the strength envelopes of peak and residual shear stress. An example of how to read collected.h5; needs python3-h5py and
python3-matplotlib.
"""
import argparse
import pathlib
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

STRESS, SEED = "study_normal_stress_kPa", "study_seed"


def read_table(group):
    """Columns of a group by name; texts become str."""
    return {name: data.asstr()[:] if h5py.check_string_dtype(data.dtype) else data[:] for name, data in group.items()}


def mixture_columns(tests):
    """What tells mixtures apart: all values of the study but stress and seed."""
    return [c for c in tests if c.startswith("study_") and c not in (STRESS, SEED)]


def mixture_of(table, columns, row):
    return tuple(table[c][row] for c in columns)


def label_of(columns, mixture):
    def word(column, value):
        if column == "study_rubber_content":
            return f"VRC {100 * value:g} %"
        shown = value if isinstance(value, str) else f"{value:g}"
        return f"{column.removeprefix('study_').replace('_', ' ')} {shown}"
    return ", ".join(word(c, v) for c, v in zip(columns, mixture)) or "all tests"


def draw_curves(figure, place, tests, shear, columns, colours):
    stresses = tests.get(STRESS, tests["normal_stress_target_kPa"])
    values = sorted(set(stresses))
    grid = place.subgridspec(2, len(values), hspace=0.08, wspace=0.12)
    share = [None, None]
    for column, stress in enumerate(values):
        panels = [figure.add_subplot(grid[row, column], sharey=share[row]) for row in (0, 1)]
        share = [share[row] or panels[row] for row in (0, 1)]
        for test in np.flatnonzero(stresses == stress):
            rows = shear["test"] == test
            colour = colours[mixture_of(tests, columns, test)]
            panels[0].plot(shear["displacement_mm"][rows], shear["shear_stress_kPa"][rows], color=colour, lw=1)
            panels[1].plot(shear["displacement_mm"][rows], shear["vertical_displacement_mm"][rows], color=colour, lw=1)
        panels[0].set_title(f"{stress:g} kPa", fontsize=10, loc="left")
        panels[0].tick_params(labelbottom=False)
        panels[1].set_xlabel("shear displacement, mm")
        panels[1].axhline(0, color="0.8", lw=0.8, zorder=0)
        for panel in panels:
            panel.tick_params(labelleft=column == 0)
        if column == 0:
            panels[0].set_ylabel("shear stress, kPa")
            panels[1].set_ylabel("rise of the plate, mm")


def draw_envelopes(figure, place, tests, envelopes, columns, colours):
    grid = place.subgridspec(1, 2, wspace=0.25)
    for k, quantity in enumerate(("peak", "residual")):
        panel = figure.add_subplot(grid[0, k])
        for row in np.flatnonzero(envelopes["quantity"] == quantity):
            mixture = mixture_of(envelopes, columns, row)
            phi, c = np.deg2rad(envelopes["friction_angle_deg"][row]), envelopes["cohesion_kPa"][row]
            members = [t for t in range(len(tests["name"])) if mixture_of(tests, columns, t) == mixture]
            sigma = tests["normal_stress_mean_kPa"][members]
            panel.plot(sigma, tests[f"{quantity}_shear_stress_kPa"][members], "o", ms=4, color=colours[mixture])
            if np.isfinite(phi):
                along = np.array([0, 1.05 * sigma.max()])
                bounds = [envelopes[f"friction_angle_{side}_deg"][row] for side in ("low", "high")]
                text = f"{np.rad2deg(phi):.0f}°" + (f" ({bounds[0]:.0f} to {bounds[1]:.0f})" if np.isfinite(bounds[0]) else "")
                panel.plot(along, c + along * np.tan(phi), color=colours[mixture], lw=1.2, label=text)
        panel.set_xlim(0)
        panel.set_ylim(0)
        panel.set_xlabel("normal stress, kPa")
        panel.set_ylabel(f"{quantity} shear stress, kPa")
        if panel.get_legend_handles_labels()[0]:
            panel.legend(fontsize=8, title="friction angle, 95 %", title_fontsize=8, frameon=False)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, help="what `dem4grm campaign collect` has written")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="default: study.png in the folder")
    options = parser.parse_args()
    path = options.folder / "collected.h5"
    if not path.exists():
        sys.exit(f"{path}: no such file; dem4grm campaign collect writes it")
    with h5py.File(path) as file:
        if "shear" not in file:
            sys.exit(f"{path}: holds no direct shear tests")
        tests, shear, envelopes = (read_table(file[g]) for g in ("tests", "shear", "envelopes"))
    columns = mixture_columns(tests)
    mixtures = sorted({mixture_of(tests, columns, t) for t in range(len(tests["name"]))})
    colours = dict(zip(mixtures, plt.cm.viridis(np.linspace(0, 0.9, len(mixtures)))))
    figure = plt.figure(figsize=(10, 10))
    grid = figure.add_gridspec(2, 1, height_ratios=[1.5, 1], hspace=0.25, top=0.92, bottom=0.06, left=0.08, right=0.98)
    draw_curves(figure, grid[0], tests, shear, columns, colours)
    draw_envelopes(figure, grid[1], tests, envelopes, columns, colours)
    handles = [plt.Line2D([], [], color=colours[m], lw=2, label=label_of(columns, m)) for m in mixtures]
    figure.legend(handles=handles, loc="upper center", ncols=min(6, len(handles)), fontsize=9, frameon=False)
    output = options.output or options.folder / "study.png"
    figure.savefig(output, dpi=130)
    print(output)


if __name__ == "__main__":
    main()
