#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the verification manual: `tools/make_verification_manual.py [--program FILE] [--only NAME]`.

Runs `dem4grm verify --manual docs/verification`, which writes manual.md, and draws its pictures into
docs/verification/pictures/. With --only the manual stays and the pictures of that case are drawn anew. Needs
python3-matplotlib.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

ROOT = pathlib.Path(__file__).resolve().parent.parent
COLOURS = ["#0e7490", "#c2410c", "#4d7c0f", "#7c3aed", "#b45309", "#be185d", "#1d4ed8", "#525252"]
MARKERS = "os^DvP*X"


def draw(picture, path):
    """Lines for what the engine gave, points for the numbers of others."""
    figure, axes = plt.subplots(figsize=(6.4, 4.0), dpi=110)
    lines = points = 0
    for series in picture["series"]:
        if series["is_reference"]:
            axes.plot(series["x"], series["y"], MARKERS[points % len(MARKERS)], color="black", mfc="white", ms=6,
                      markevery=max(1, len(series["x"]) // 24), label=series["label"], zorder=3)
            points += 1
        else:
            axes.plot(series["x"], series["y"], color=COLOURS[lines % len(COLOURS)], lw=1.6, label=series["label"])
            lines += 1
    axes.set_xlabel(picture["x_label"])
    axes.set_ylabel(picture["y_label"])
    axes.set_title(picture["title"], fontsize=10, loc="left")
    axes.grid(color="#e5e5e5", lw=0.6)
    axes.spines[["top", "right"]].set_visible(False)
    beside = {"loc": "center left", "bbox_to_anchor": (1.0, 0.5)} if lines + points > 6 else {}
    axes.legend(fontsize=8, frameon=False, **beside)
    figure.tight_layout()
    figure.savefig(path, metadata={"Software": None})
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=ROOT / "build/release/apps/dem4grm/dem4grm", type=pathlib.Path)
    parser.add_argument("--only", action="append", default=[], metavar="NAME", help="only the pictures of this case")
    options = parser.parse_args()
    target = ROOT / "docs/verification"
    with tempfile.TemporaryDirectory() as folder:
        command = [str(options.program), "verify", "--manual", folder]
        for name in options.only:
            command += ["--only", name]
        result = subprocess.run(command, stdout=subprocess.DEVNULL, check=False)
        if not (pathlib.Path(folder) / "curves.json").exists():
            sys.exit("make_verification_manual: the suite did not run")
        pictures = json.loads((pathlib.Path(folder) / "curves.json").read_text(encoding="utf-8"))
        if not options.only:
            (target / "manual.md").write_bytes((pathlib.Path(folder) / "manual.md").read_bytes())
    (target / "pictures").mkdir(parents=True, exist_ok=True)
    if not options.only:
        wanted = {f"{p['name']}.png" for p in pictures}
        for old in (target / "pictures").glob("*.png"):
            if old.name not in wanted:
                old.unlink()
    for picture in pictures:
        draw(picture, target / "pictures" / f"{picture['name']}.png")
    print(f"{len(pictures)} pictures in {target / 'pictures'}")
    return result.returncode


if __name__ == "__main__":
    sys.exit(main())
