#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Shear stress, dilation and stress-dilatancy of one or more tests: `shear_curves.py FOLDER... [-o curves.png]`.

The article's Figs. 10 and 11. For a campaign: `shear_curves.py runs/quick-study/tests/*`.
"""
import argparse

import test_folder as test
from test_folder import plt


def draw(folders):
    figure, (stress, rise, dilatancy) = plt.subplots(1, 3, figsize=(13, 4), layout="constrained")
    for folder in folders:
        rows, name = test.table(folder), test.label(folder)
        line, = stress.plot(rows["displacement_mm"], rows["shear_stress_kPa"], lw=1.2, label=name)
        rise.plot(rows["displacement_mm"], rows["vertical_displacement_mm"], lw=1.2, color=line.get_color())
        dilatancy.plot(rows["dilation_rate"], rows["shear_ratio"], lw=0.8, color=line.get_color())
    stress.set(xlabel="shear displacement, mm", ylabel="shear stress, kPa")
    rise.set(xlabel="shear displacement, mm", ylabel="rise of the plate, mm (dilation positive)")
    dilatancy.set(xlabel="dilation rate", ylabel="shear stress over normal stress")
    for axes in (stress, rise):
        axes.set_xlim(0)
    rise.axhline(0, color="0.7", lw=0.8, zorder=0)
    stress.legend(fontsize=8, frameon=False)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folders", nargs="+", help="output folders of direct shear tests")
    parser.add_argument("-o", "--output", default="curves.png")
    options = parser.parse_args()
    test.save(draw(options.folders), options.output)
    for folder in options.folders:
        facts = test.summary(folder)
        print(f"{folder}: peak {facts['peak_shear_stress_kPa']:.1f} kPa at {facts['displacement_at_peak_mm']:.2f} mm")


if __name__ == "__main__":
    main()
