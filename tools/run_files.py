# SPDX-License-Identifier: BSD-3-Clause
"""Reads what a run writes, and fills the marked tables of result pages, for the scripts beside it."""
import csv
import json

import numpy as np


def read_csv(path):
    """Columns of a CSV file of numbers by name, each an array of one value a row."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    whole = [r for r in rows[1:] if len(r) == len(rows[0])]  # the last row of a running test may be half written
    return {name: np.array([float(r[k]) for r in whole]) for k, name in enumerate(rows[0])}


def read_json(folder, name="summary.json"):
    """A JSON file of an output folder; None when it is not there yet."""
    path = folder / name
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else None


def write_rows(path, rows):
    """A CSV file of rows that are dictionaries with the same keys; floats with six digits."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows({k: f"{v:.6g}" if isinstance(v, float) else v for k, v in row.items()} for row in rows)


def fill_page(page, tables):
    """Puts each table (Markdown text by its name) between the marks `<!-- name -->` and `<!-- end of name -->` of a page."""
    text = page.read_text(encoding="utf-8")
    for name, table in tables.items():
        begin, end = f"<!-- {name} -->", f"<!-- end of {name} -->"
        head, rest = text.split(begin)
        text = head + begin + "\n\n" + table + "\n\n" + end + rest.split(end)[1]
    page.write_text(text, encoding="utf-8")
