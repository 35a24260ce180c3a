#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Strength, strong network and rubber strain of a study against rubber content: `campaign.py COLLECTED [-o campaign.png]`.

COLLECTED is the folder that `dem4grm campaign collect` fills. Mohr envelopes of peak and residual stress; shares of the kinds among the strong
contacts at the end of shear (the article's Fig. 17) and mean compression of the bonds in the rubber (Fig. 18).
"""
import argparse
import pathlib

import h5py
import numpy as np

import test_folder as test
from test_folder import plt


def read(file, group):
    """Columns of a table of collected.h5; texts as str."""
    return {name: data.asstr()[:] if h5py.check_string_dtype(data.dtype) else data[:] for name, data in file[group].items()}


def last_rows(table, n_tests):
    """Row with the largest displacement of each test; -1 for a test without rows."""
    rows = [np.flatnonzero(table["test"] == k) for k in range(n_tests)]
    return np.array([r[table["displacement_mm"][r].argmax()] if len(r) else -1 for r in rows])


def draw_envelopes(axes, tests, envelopes, quantity):
    rows = np.flatnonzero(envelopes["quantity"] == quantity)
    for k, row in enumerate(rows):
        content = envelopes["study_rubber_content"][row]
        members = tests["study_rubber_content"] == content
        sigma, tau = tests["normal_stress_mean_kPa"][members], tests[f"{quantity}_shear_stress_kPa"][members]
        axes.plot(sigma, tau, "o", color=f"C{k}")
        phi, cohesion = envelopes["friction_angle_deg"][row], envelopes["cohesion_kPa"][row]
        along = np.array([0, 1.05 * sigma.max()])
        axes.plot(along, cohesion + along * np.tan(np.radians(phi)), color=f"C{k}", lw=1.2,
                  label=f"VRC {100 * content:.0f} %: {phi:.0f} degrees, {cohesion:.0f} kPa")
        print(f"{quantity}, VRC {100 * content:.0f} %: phi {phi:.2f} degrees, c {cohesion:.2f} kPa")
    axes.set(xlabel="normal stress, kPa", ylabel=f"{quantity} shear stress, kPa", xlim=(0, None), ylim=(0, None))
    if len(rows):
        axes.legend(fontsize=7, frameon=False)
    else:  # a residual needs 2 mm of shear, an envelope two stresses
        axes.text(0.5, 0.5, "no envelope: tests too short or too few", transform=axes.transAxes, ha="center", color="0.4")


def draw_against_content(network, strain, tests, micro):
    rows = last_rows(micro, len(tests["name"]))
    rubber = 100 * tests["study_rubber_content"]
    for kind, name, colour in zip(("gg", "gr", "rr"), test.KINDS, test.COLOURS):
        network.plot(rubber, micro[f"strong_share_{kind}"][rows], "o", color=colour, label=name)
    for stress in np.unique(tests["study_normal_stress_kPa"]):
        here = tests["study_normal_stress_kPa"] == stress
        strain.plot(rubber[here], 100 * micro["bond_strain"][rows[here]], "o", label=f"{stress:.0f} kPa")
    network.axhline(0.5, color="0.7", lw=0.8, ls="--")  # more than half: rigid (g-g) or soft (r-r), else intermediate
    network.set(xlabel="rubber content, % by volume", ylabel="share of the strong contacts", ylim=(0, 1))
    strain.set(xlabel="rubber content, % by volume", ylabel="mean strain of the bonds, %")
    for axes in (network, strain):
        axes.set_xlim(-5, 105)
        axes.legend(fontsize=7, frameon=False)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("collected", type=pathlib.Path, help="folder with collected.h5")
    parser.add_argument("-o", "--output", default="campaign.png")
    options = parser.parse_args()
    with h5py.File(options.collected / "collected.h5") as file:
        tests, envelopes, micro = (read(file, group) for group in ("tests", "envelopes", "micro"))
    figure, panels = plt.subplots(1, 4, figsize=(16, 4), layout="constrained")
    for axes, quantity in zip(panels, ("peak", "residual")):
        draw_envelopes(axes, tests, envelopes, quantity)
    draw_against_content(panels[2], panels[3], tests, micro)
    test.save(figure, options.output)


if __name__ == "__main__":
    main()
