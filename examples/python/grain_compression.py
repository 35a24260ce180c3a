#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""One rubber grain between two plates: `grain_compression.py FOLDER [-o grain.png]`.

The article's Figs. 4, 6 and 7: load, secant stiffness and Poisson's ratio. The knee is where second neighbours begin to touch.
"""
import argparse

import test_folder as test
from test_folder import plt


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", help="output folder of a grain compression")
    parser.add_argument("-o", "--output", default="grain.png")
    options = parser.parse_args()
    rows, facts = test.table(options.folder, "grain"), test.summary(options.folder)
    figure, (load, stiffness, poisson) = plt.subplots(1, 3, figsize=(12, 3.6), layout="constrained")
    strain = 100 * rows["strain"]
    load.plot(rows["displacement_mm"], rows["load_N"], color="#31475e")
    load.set(xlabel="displacement, mm", ylabel="load, N")
    stiffness.plot(strain, rows["load_N"] / rows["displacement_mm"], color="#31475e")
    stiffness.set(xlabel="strain, %", ylabel="secant stiffness, N/mm")
    poisson.plot(strain, rows["poisson_ratio"], color="#31475e")
    poisson.set(xlabel="strain, %", ylabel="Poisson's ratio")
    if facts["knee_strain"]:
        for axes in (stiffness, poisson):
            axes.axvline(100 * facts["knee_strain"], color="0.6", lw=0.8, ls="--")
    test.save(figure, options.output)
    print(f"load at {strain[-1]:.0f} %: {rows['load_N'][-1]:.3f} N, first stiffness {facts['initial_stiffness_N_per_mm']:.3f} N/mm")


if __name__ == "__main__":
    main()
