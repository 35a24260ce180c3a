# SPDX-License-Identifier: BSD-3-Clause
"""Reads what a run writes, for the scripts beside it."""
import csv

import numpy as np


def read_csv(path):
    """Columns of a CSV file of numbers by name, each an array of one value a row."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    whole = [r for r in rows[1:] if len(r) == len(rows[0])]  # the last row of a running test may be half written
    return {name: np.array([float(r[k]) for r in whole]) for k, name in enumerate(rows[0])}
