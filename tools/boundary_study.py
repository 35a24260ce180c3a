#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reads the campaign of cases/studies/boundaries.toml: `tools/boundary_study.py runs/boundaries`.

Writes docs/results/boundaries.csv, one row a test, and the table of docs/results/boundaries.md: mean and standard deviation over
the seeds for each roughness of the plates and each split plane. Shares of the shear stress are means over 0.5 mm about the peak
and over the last 2 mm.
"""
import argparse
import pathlib
import sys

import numpy as np

from run_files import fill_page, read_csv, read_json, write_rows

PAGE = pathlib.Path(__file__).resolve().parent.parent / "docs" / "results" / "boundaries.md"
ROWS = (("void_ratio_before_shear", "void ratio before shear", 3), ("k0_x", "K0 along x", 2),
        ("peak_shear_stress_kPa", "peak, kPa", 0), ("displacement_at_peak_mm", "displacement at the peak, mm", 1),
        ("residual_shear_stress_kPa", "residual, kPa", 0), ("dilation_angle_deg", "dilation angle, degrees", 0),
        ("vertical_displacement_at_end_mm", "rise at 14 mm, mm", 2), ("taylor_friction_at_peak", "Taylor's friction at the peak", 2),
        ("plate_share_at_peak", "share of the bottom plate in the shear stress at the peak", 2),
        ("plate_share_residual", "the same, last 2 mm", 2), ("end_wall_share_at_peak", "share of the lower end walls at the peak", 2),
        ("band_thickness_mm", "shear band at 14 mm: thickness, mm", 1), ("band_centre_mm", "its middle, mm", 1),
        ("split_height_mm", "split plane, mm", 1))


def shares(folder, area, middle, width):
    """Shares of bottom plate and lower end walls in the shear stress, means over a window of displacement (mm)."""
    shear, walls = read_csv(folder / "shear.csv"), read_csv(folder / "walls.csv")
    rows = np.abs(shear["displacement_mm"] - middle) <= width / 2
    stress = shear["shear_stress_kPa"][rows].mean()
    ends = -(walls["lower_xmin_fx_N"] + walls["lower_xmax_fx_N"])[rows].mean() / area * 1e-3
    return shear["plate_shear_stress_kPa"][rows].mean() / stress, ends / stress


def read_test(test, folder):
    summary = read_json(folder)
    area = 0.050 * 0.050  # m2, of the study's box
    out = {name: value for name, value in test.items() if name in ("walls.plate_roughness", "box.split_plane", "seed")}
    peak_plate, peak_ends = shares(folder, area, summary["displacement_at_peak_mm"], 0.5)
    last_plate, _ = shares(folder, area, summary["shear_displacement_mm"] - 1.0, 2.0)
    band = summary["shear_band"][-1]
    out |= {name: summary[name] for name, _, _ in ROWS if name in summary}
    return out | {"taylor_friction_at_peak": summary["dilatancy_at_peak"]["taylor_friction"],
                  "plate_share_at_peak": peak_plate, "plate_share_residual": last_plate, "end_wall_share_at_peak": peak_ends,
                  "band_thickness_mm": band["thickness_mm"], "band_centre_mm": band["centre_mm"],
                  "state_hash": summary["state_hash"]}


def table(tests):
    groups = {}
    for test in tests:
        groups.setdefault((test["walls.plate_roughness"], test["box.split_plane"]), []).append(test)
    lines = ["| ribs, split plane | " + " | ".join(f"{a}, {b}" for a, b in groups) + " |", "| --- |" + " --- |" * len(groups)]
    for name, label, digits in ROWS:
        values = [np.array([t[name] for t in tests]) for tests in groups.values()]
        cells = (f"{v.mean():.{digits}f} +- {v.std(ddof=1):.{max(digits, 1)}f}" for v in values)
        lines.append(f"| {label} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("campaign", type=pathlib.Path, help="folder of the finished campaign")
    options = parser.parse_args()
    plan = read_json(options.campaign, "campaign.json")
    tests = []
    for test in plan["tests"]:
        folder = options.campaign / "tests" / test["name"]
        if not (folder / "summary.json").exists():
            print(f"{folder}: not finished", file=sys.stderr)
            return 66
        tests.append(read_test({v["key"]: v["value"].strip('"') for v in test["values"]}, folder))
    write_rows(PAGE.with_suffix(".csv"), tests)
    fill_page(PAGE, {"table": table(tests)})
    return 0


if __name__ == "__main__":
    sys.exit(main())
