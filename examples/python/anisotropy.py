#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Anisotropies, direction of the forces and bulk friction in shear: `anisotropy.py FOLDER... [-o anisotropy.png]`.

The article's Figs. 15 and 16, from micro.csv; how the numbers are defined stands in docs/theory/micro-mechanics.md.
"""
import argparse

import test_folder as test
from test_folder import plt

PANELS = (("a_all", "fabric, a"), ("a_n_all", "normal force, a_n"), ("a_t_all", "tangential force, a_t"),
          ("theta_n_all_deg", "major axis of the normal force, degrees"), ("bulk_friction_all", "bulk friction"))


def draw(folders):
    figure, panels = plt.subplots(1, len(PANELS), figsize=(17, 3.6), layout="constrained")
    for folder in folders:
        rows = test.table(folder, "micro")
        for axes, (column, _) in zip(panels, PANELS):
            axes.plot(rows["displacement_mm"], rows[column], lw=1.2, label=test.label(folder))
        # Below this, an amplitude cannot be told from that of contacts without a direction.
        panels[0].plot(rows["displacement_mm"], rows["a_noise_all"], lw=0.7, ls=":", color=panels[0].lines[-1].get_color())
    for axes, (column, title) in zip(panels, PANELS):
        axes.set(xlabel="shear displacement, mm", title=title)
        axes.set_xlim(0)
        axes.set_ylim(*((0, 180) if column.startswith("theta") else (0, None)))
    panels[-1].legend(fontsize=7, frameon=False)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folders", nargs="+", help="output folders of direct shear tests")
    parser.add_argument("-o", "--output", default="anisotropy.png")
    options = parser.parse_args()
    test.save(draw(options.folders), options.output)


if __name__ == "__main__":
    main()
