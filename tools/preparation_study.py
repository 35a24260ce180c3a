#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fills docs/results/preparation.md from finished runs, and writes one row a run with its state hash beside it.

    tools/preparation_study.py --density runs/preparation --choices runs/choices --rubber runs/contraction
    tools/preparation_study.py --loose runs/loose-rubber --full runs/contraction-full
    tools/preparation_study.py --fit runs/gravel-30 runs/gravel-60 ...

All but --fit are folders of campaigns (cases/studies/preparation.toml, choices.toml, contraction.toml, ...); --fit takes folders
of finished specimens (dem4grm specimen) of VRC 0 and 100. Each fills its table and its part of the CSV file. Mean and standard deviation
over the seeds.
"""
import argparse
import pathlib
import sys

import matplotlib
import numpy as np

from run_files import fill_page, read_csv, read_json, write_rows

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the backend was chosen)

PAGE = pathlib.Path(__file__).resolve().parent.parent / "docs" / "results" / "preparation.md"
PUBLISHED = {(0.0, 30): 0.534, (0.0, 60): 0.516, (0.0, 100): 0.511, (1.0, 30): 0.782, (1.0, 60): 0.681, (1.0, 100): 0.598}
QUANTITIES = (("void_ratio_min", "e_min", 3), ("void_ratio_max", "e_max", 3), ("void_ratio_before_shear", "e", 3), ("k0_x", "K0", 2),
              ("peak_shear_stress_kPa", "peak, kPa", 0), ("displacement_at_peak_mm", "at, mm", 1),
              ("last_kPa", "last mm, kPa", 0), ("dilation_angle_deg", "dilation, degrees", 1),
              ("largest_contraction_mm", "contraction, mm", 2), ("vertical_displacement_at_end_mm", "rise at 14 mm, mm", 2),
              ("void_ratio_at_end", "e at 14 mm", 3), ("band_mm", "band, mm", 1), ("band_void_ratio", "e in the band", 3))
PICTURE = PAGE.parent.parent / "pictures" / "rubber-contraction.png"
COLOURS = {30: "tab:blue", 60: "tab:orange", 100: "tab:red"}
CAMPAIGNS = ("density", "choices", "rubber", "loose", "full")
NAMES = {"specimen.rubber_content": "VRC", "specimen.generation_relative_density": "D_g", "shear.normal_stress": "stress",
         "specimen.clump_shapes": "shapes", "specimen.gravel_grading": "grading", "specimen.generation": "fill",
         "specimen.generation_void_ratio": "e of the fill", "contact.hz_mode": "hz_mode",
         "specimen.preparation_friction": "friction", "integration.local_damping": "local damping", "shear.velocity": "velocity"}


def band_of(band, profiles):
    """Thickness of the shear band at the end, and void ratio of its middle half."""
    if band["thickness_mm"] is None:
        return np.nan, np.nan
    at_end = profiles["shear_displacement_mm"] == profiles["shear_displacement_mm"].max()
    middle = (profiles["low_mm"] + profiles["high_mm"]) / 2
    inside = at_end & (np.abs(middle - band["centre_mm"]) <= band["thickness_mm"] / 4)
    solid = 1 / (1 + profiles["void_ratio"][inside])
    return band["thickness_mm"], 1 / solid.mean() - 1


def numbers_of(folder):
    """The quantities of one finished test."""
    summary, shear = read_json(folder), read_csv(folder / "shear.csv")
    out = {name: summary.get(name) for name, _, _ in QUANTITIES}
    u, rise = shear["displacement_mm"], shear["vertical_displacement_mm"]
    out["last_kPa"] = shear["shear_stress_kPa"][u > u[-1] - 1.0].mean()
    out["largest_contraction_mm"] = max(0.0, -rise.min())
    out["band_mm"], out["band_void_ratio"] = band_of(summary["shear_band"][-1], read_csv(folder / "profiles.csv"))
    return {name: np.nan if value is None else value for name, value in out.items()} | {"state_hash": summary["state_hash"]}


def tests_of(campaign):
    """[(group, seed, numbers)] of the tests that are done; the others are named on stderr."""
    tests = []
    for test in read_json(campaign, "campaign.json")["tests"]:
        folder = campaign / "tests" / test["name"]
        if not (folder / "summary.json").exists():
            print(f"{folder}: not finished", file=sys.stderr)
            continue
        values = {v["key"]: v["value"].strip('"') for v in test["values"]}
        seed = values.pop("seed", "1")
        group = ", ".join(f"{NAMES.get(key, key)} {pathlib.Path(value).name if value.endswith('.csv') else value}" for key, value in values.items())
        tests.append((group or "our defaults", seed, numbers_of(folder)))
    return tests


def table_of(tests):
    groups = {}
    for group, _, numbers in tests:
        groups.setdefault(group, []).append(numbers)
    lines = ["| | seeds | " + " | ".join(label for _, label, _ in QUANTITIES) + " |", "| --- |" + " --- |" * (len(QUANTITIES) + 1)]
    for group, members in groups.items():
        cells = []
        for name, _, digits in QUANTITIES:
            values = np.array([m[name] for m in members])
            spread = f" +- {values.std(ddof=1):.{max(digits, 1)}f}" if len(values) > 1 else ""
            cells.append("-" if np.isnan(values).all() else f"{values.mean():.{digits}f}{spread}")
        lines.append(f"| {group} | {len(members)} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def fit_rows(folders):
    rows = []
    for folder in folders:
        s = read_json(folder, "specimen.json") or read_json(folder)
        vrc, stress = round(s["rubber_content"], 2), round(s["normal_stress_target_kPa"])
        span = s["void_ratio_max"] - s["void_ratio_min"]
        exact = s["void_ratio_before_shear"] + (s["relative_density"] - 0.5) * span
        rows.append({"vrc": vrc, "stress_kPa": stress, "void_ratio_generated": s["void_ratio_generated"], "e_min": s["void_ratio_min"],
                     "e_max": s["void_ratio_max"], "friction": s["preparation_friction"], "relative_density": s["relative_density"],
                     "e": s["void_ratio_before_shear"], "e_at_50_percent": exact, "k0_x": s["k0_x"], "steps": s["steps"],
                     "published": PUBLISHED[(vrc, stress)], "state_hash": s["state_hash"]})
    return sorted(rows, key=lambda r: (r["vrc"], r["stress_kPa"]))


def fit_table(rows):
    lines = ["| VRC % | kPa | fill | e_min | e_max | friction | D_r % | e | published | difference | at exactly 50 % | K0 | steps |",
             "| --- |" + " --- |" * 12]
    for r in rows:
        lines.append(f"| {100 * r['vrc']:.0f} | {r['stress_kPa']} | {r['void_ratio_generated']:.3f} | {r['e_min']:.3f} | {r['e_max']:.3f} | "
                     f"{r['friction']:.4f} | {100 * r['relative_density']:.1f} | {r['e']:.3f} | {r['published']:.3f} | "
                     f"{r['e'] - r['published']:+.3f} | {r['e_at_50_percent'] - r['published']:+.3f} | {r['k0_x']:.2f} | {r['steps']:,} |")
    return "\n".join(lines)


def draw_rubber(full, loose):
    """Rise of the plate in shear: rubber in the published box, and as loose as friction can make it in a fourth of the area."""
    figure, axis = plt.subplots(figsize=(6.4, 4.0), constrained_layout=True)
    for campaign, style, what in ((full, "-", "published box"), (loose, "--", "a fourth of its area, as loose as can be")):
        for test in read_json(campaign, "campaign.json")["tests"]:
            folder = campaign / "tests" / test["name"]
            if not (folder / "summary.json").exists():
                continue
            stress = round(read_json(folder)["normal_stress_target_kPa"])
            shear = read_csv(folder / "shear.csv")
            axis.plot(shear["displacement_mm"], shear["vertical_displacement_mm"], style, color=COLOURS[stress], lw=1.4,
                      label=f"{stress} kPa, {what}")
    axis.axhline(0.0, color="0.5", lw=0.8)
    axis.set_xlabel("shear displacement, mm")
    axis.set_ylabel("rise of the top plate, mm")
    axis.grid(alpha=0.25)
    axis.legend(fontsize=8, frameon=False)
    figure.savefig(PICTURE, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--fit", type=pathlib.Path, nargs="+", help="folders of finished specimens")
    for name in CAMPAIGNS:
        parser.add_argument(f"--{name}", type=pathlib.Path, help="folder of a campaign")
    options = parser.parse_args()
    if options.fit:
        rows = fit_rows(options.fit)
        write_rows(PAGE.with_name("preparation-fit.csv"), rows)
        fill_page(PAGE, {"fit": fit_table(rows)})
    for name in CAMPAIGNS:
        campaign = getattr(options, name)
        if campaign is None:
            continue
        tests = tests_of(campaign)
        write_rows(PAGE.with_name(f"preparation-{name}.csv"), [{"test": group, "seed": seed} | numbers for group, seed, numbers in tests])
        fill_page(PAGE, {name: table_of(tests)})
    if options.full and options.loose:
        draw_rubber(options.full, options.loose)
    return 0


if __name__ == "__main__":
    sys.exit(main())
