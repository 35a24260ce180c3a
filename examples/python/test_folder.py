# SPDX-License-Identifier: BSD-3-Clause
"""Reads output folders of DEM4GRM with NumPy and h5py only: what the scripts beside it share. Copy it next to your own."""
import csv
import json
import pathlib

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")  # draws into files, also where there is no display
import matplotlib.pyplot as plt  # noqa: E402

KINDS = ("gravel-gravel", "gravel-rubber", "rubber-rubber")
COLOURS = ("#c2410c", "#7c3aed", "#0e7490")  # of the kinds; colour-blind eyes tell them apart


def table(folder, name="shear"):
    """Columns of shear.csv, micro.csv, profiles.csv, walls.csv or grain.csv by name, each an array."""
    with open(pathlib.Path(folder) / f"{name}.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    values = np.array([row for row in rows[1:] if len(row) == len(rows[0])], dtype=float)  # a running test may be mid-row
    return dict(zip(rows[0], values.T))


def summary(folder):
    """summary.json of a finished test as a dictionary."""
    return json.loads((pathlib.Path(folder) / "summary.json").read_text(encoding="utf-8"))


def label(folder):
    """Rubber content and normal stress, or the name of the test."""
    facts = summary(folder)
    return f"VRC {100 * facts['rubber_content']:.0f} %, {facts['normal_stress_target_kPa']:.0f} kPa"


def displacements(folder):
    """Displacement in mm of every stored state."""
    with h5py.File(pathlib.Path(folder) / "results.h5") as file:
        return np.array([frame.attrs["displacement"] * 1e3 for frame in file["frames"].values()])


def state(folder, displacement_mm):
    """The stored state nearest to a displacement: arrays by group and name in SI units, and its displacement in mm."""
    nearest = int(np.abs(displacements(folder) - displacement_mm).argmin())
    with h5py.File(pathlib.Path(folder) / "results.h5") as file:
        frame = list(file["frames"].values())[nearest]
        arrays = {group: {name: data[()] for name, data in frame[group].items()} for group in frame}
        return arrays, frame.attrs["displacement"] * 1e3


def contacts_between_grains(arrays):
    """The contacts of a state without those with walls, and their kinds as rows of KINDS."""
    contacts = arrays["contacts"]
    between = contacts["wall"] < 0
    chosen = {name: values[between] for name, values in contacts.items()}
    material = arrays["balls"]["material"].astype(int)  # 0 gravel, 1 rubber
    chosen["kind"] = material[chosen["ball_i"]] + material[chosen["ball_j"]]
    return chosen


def body_centres(arrays):
    """Centres of all grains in m by body id: rubber grains first, then clumps."""
    return np.vstack([arrays["rubber_grains"]["centre"].reshape(-1, 3), arrays["clumps"]["position"].reshape(-1, 3)])


def save(figure, path):
    figure.savefig(path, dpi=150)
    plt.close(figure)
    print(path)
