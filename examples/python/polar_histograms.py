#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Polar histograms of contacts and forces with their fits: `polar_histograms.py FOLDER [--at 0 2 8] [-o polar.png]`.

The article's Figs. 12 to 14, made from the stored contacts. Each histogram is fitted by its mean times 1 + a cos k (theta - theta_a), with
k = 2 for contacts and normal forces and 4 for tangential forces; `dem4grm micro FOLDER --at 8mm` prints the same numbers.
"""
import argparse

import numpy as np

import test_folder as test
from test_folder import plt

BINS = 18  # of 10 degrees, on the half circle: a contact looks the same from both sides
WIDTH = np.pi / BINS
CENTRES = (np.arange(BINS) + 0.5) * WIDTH


def histograms(contacts):
    """Name: (value in each bin, order of the harmonic)."""
    angle = np.arctan2(contacts["normal"][:, 2], contacts["normal"][:, 0]) % np.pi  # from x, the shear direction
    bins = np.minimum((angle / WIDTH).astype(int), BINS - 1)
    count = np.bincount(bins, minlength=BINS)

    def mean(values):
        with np.errstate(invalid="ignore"):  # an empty bin has no mean
            return np.bincount(bins, values, BINS) / count

    return {"contacts, share per radian": (count / (2 * count.sum() * WIDTH), 2),
            "normal force, N": (mean(contacts["normal_force"]), 2),
            "tangential force, N": (mean(np.linalg.norm(contacts["shear_force"], axis=1)), 4)}


def fit(values, order):
    """Mean, amplitude over the mean and direction in radians, by least squares over the bins that have a value."""
    there = np.isfinite(values)
    columns = np.column_stack([np.ones(BINS), np.cos(order * CENTRES), np.sin(order * CENTRES)])
    mean, c, s = np.linalg.lstsq(columns[there], values[there], rcond=None)[0]
    smeared = np.sin(order * WIDTH / 2) / (order * WIDTH / 2)  # what the width of the bins takes from the amplitude
    return mean, np.hypot(c, s) / mean / smeared, (np.arctan2(s, c) / order) % (2 * np.pi / order)


def draw(folder, displacements):
    figure, panels = plt.subplots(3, len(displacements), figsize=(3 * len(displacements), 9.5), squeeze=False,
                                  subplot_kw={"projection": "polar"}, layout="constrained")
    for column, wanted in enumerate(displacements):
        arrays, at = test.state(folder, wanted)
        words = [f"{at:.2f} mm"]
        for axes, (name, (values, order)) in zip(panels[:, column], histograms(test.contacts_between_grains(arrays)).items()):
            mean, amplitude, direction = fit(values, order)
            both = np.r_[CENTRES, CENTRES + np.pi]
            axes.bar(both, np.tile(np.nan_to_num(values), 2), width=WIDTH, color="#b9a27f", edgecolor="white", lw=0.4)
            theta = np.linspace(0, 2 * np.pi, 361)
            axes.plot(theta, mean * (1 + amplitude * np.cos(order * (theta - direction))), color="#31475e", lw=1.5)
            axes.set_title(f"{at:.2f} mm: {name}\n{amplitude:.3f}, {np.degrees(direction):.1f} degrees", fontsize=8)
            axes.set_xticks(np.radians([0, 90, 180, 270]))
            axes.tick_params(labelsize=7)
            axes.set_yticklabels([])
            words.append(f"{amplitude:.4f} at {np.degrees(direction):.2f} degrees")
        print("; ".join(words))
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", help="output folder of a direct shear test")
    parser.add_argument("--at", type=float, nargs="+", default=[0, 2, 8], metavar="MM", help="the nearest stored states are drawn")
    parser.add_argument("-o", "--output", default="polar.png")
    options = parser.parse_args()
    test.save(draw(options.folder, options.at), options.output)


if __name__ == "__main__":
    main()
