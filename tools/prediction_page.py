#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Records the prediction: `tools/prediction_page.py FOLDER` of `dem4grm campaign run cases/studies/prediction.toml -o FOLDER`.

For each finished test it writes docs/results/prediction/NAME.csv (the curve, one row each 0.1 mm) and NAME.micro.csv (micro-mechanics), fills the
tables of docs/results/prediction.md and draws docs/pictures/prediction.png. A test that is there already is written again only when its
state hash is the same; another result is an error, since no prediction is changed after the fact. What
`dem4grm campaign collect FOLDER` found before gives the strength of mixtures with two stresses.
"""
import argparse
import csv
import pathlib
import sys

import matplotlib
import numpy as np

from run_files import fill_page, read_csv, read_json, write_rows

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the backend was chosen)
from matplotlib.lines import Line2D  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE, FILES, PICTURE = ROOT / "docs/results/prediction.md", ROOT / "docs/results/prediction", ROOT / "docs/pictures/prediction.png"
STEP = 0.1  # mm
CURVE = ["displacement_mm", "shear_stress_kPa", "normal_stress_kPa", "vertical_displacement_mm", "void_ratio", "dilation_rate", "inertial_number"]
MICRO = ["displacement_mm", "contacts_all", "a_all", "theta_a_all_deg", "a_n_all", "theta_n_all_deg", "a_t_all", "theta_t_all_deg", "a_t2_all", "a_s_all",
         "bulk_friction_all", "strong_share_gg", "strong_share_gr", "strong_share_rr", "strong_load_share_gg", "strong_load_share_gr",
         "strong_load_share_rr", "zone", "coordination", "bond_strain", "grain_strain_vertical", "stress_ratio", "stress_ratio_of_fabric"]
# Of the names of tests: colours and styles of the picture.
MIXTURES = ("vrc000", "vrc010", "vrc025", "vrc040", "vrc070", "vrc100")
STYLES = {"100kPa": "-", "060kPa": "--", "030kPa": ":"}


def thin(columns, names, step=None):
    """Rows of a table as dictionaries; with a step the ones nearest to its multiples, each once."""
    displacement = columns["displacement_mm"]
    rows = range(len(displacement))
    if step is not None:
        marks = np.arange(0.0, displacement[-1] + step / 2, step)
        rows = sorted({int(np.argmin(np.abs(displacement - mark))) for mark in marks})
    return [{name: float(columns[name][row]) for name in names if name in columns} for row in rows]


def label(name):
    """'vrc010-100kPa' as 'VRC 10 %, 100 kPa'; what follows (a seed, numbers of grains) in brackets."""
    mixture, stress, *rest = name.split("-")
    return f"VRC {int(mixture[3:])} %, {int(stress[:-3])} kPa" + (f" ({' '.join(rest)})" if rest else "")


def theta(micro):
    """Direction of the normal forces at the start, its smallest value with its displacement, and at the end, degrees."""
    angle, at = micro["theta_n_all_deg"], micro["displacement_mm"]
    least = int(np.nanargmin(angle))
    return f"{angle[0]:.0f}, {angle[least]:.1f} at {at[least]:.1f} mm, {angle[-1]:.1f}"


def at_peak(summary, micro, column):
    return float(micro[column][int(np.argmin(np.abs(micro["displacement_mm"] - summary["displacement_at_peak_mm"])))])


def peak_text(s):
    stress = s["peak_shear_stress_kPa"]
    return f"hardens to {stress:.1f}" if s["hardening"] else f"{stress:.1f} at {s['displacement_at_peak_mm']:.2f} mm"


def number(value, digits=1):
    return "-" if value is None else f"{value:.{digits}f}"


def curve_table(tests):
    lines = ["| test | grains (gravel, rubber) | e before shear | peak, kPa | residual, kPa | dilation angle, degrees | largest contraction, rise at the end, mm | K0 |",
             "| --- | --- | --- | --- | --- | --- | --- | --- |"]
    for name, s, _, _ in tests:
        lines.append(f"| {label(name)} | {s['clumps']}, {s['rubber_grains']} | {s['void_ratio_before_shear']:.3f} | {peak_text(s)} "
                     f"| {number(s['residual_shear_stress_kPa'])} | {number(s['dilation_angle_deg'])} "
                     f"| {number(s['largest_contraction_mm'], 2)}, {s['vertical_displacement_at_end_mm']:.2f} | {s['k0_x']:.2f} |")
    return "\n".join(lines)


def micro_table(tests):
    lines = ["| test | theta_n at the start, least, at the end, degrees | a, a_n, a_t at the peak | bulk friction at the peak "
             "| strong contacts at the peak g-g, g-r, r-r, % | zone | mean bond strain at the peak, % |",
             "| --- | --- | --- | --- | --- | --- | --- |"]
    for name, s, _, micro in tests:
        def value(column):
            return at_peak(s, micro, column)
        shares = ", ".join(f"{100 * value(c):.0f}" for c in ("strong_share_gg", "strong_share_gr", "strong_share_rr"))
        strain = f"{100 * value('bond_strain'):.2f}" if s["rubber_grains"] else "-"
        lines.append(f"| {label(name)} | {theta(micro)} | {value('a_all'):.3f}, {value('a_n_all'):.3f}, {value('a_t_all'):.3f} "
                     f"| {value('bulk_friction_all'):.3f} | {shares} | {(s.get('micro_at_peak') or {}).get('zone') or '-'} | {strain} |")
    return "\n".join(lines)


def origin_table(tests):
    lines = ["| test | commit | friction of preparation, relative density, % | velocity, mm/s | inertial number at most | steps | state hash at the end |",
             "| --- | --- | --- | --- | --- | --- | --- |"]
    for name, s, _, _ in tests:
        density = "-" if s["relative_density"] is None else f"{100 * s['relative_density']:.1f}"
        lines.append(f"| {label(name)} | {s['commit']} | {s['preparation_friction']:.4f}, {density} | {s['shear_velocity_mm_per_s']:.2f} "
                     f"| {s['inertial_number_max']:.2e} | {s['steps']} | `{s['state_hash']}` |")
    return "\n".join(lines)


def strength_table(folder):
    """Mohr envelopes of the mixtures with at least two stresses, as `dem4grm campaign collect` found them."""
    path = folder / "collected/envelopes.csv"
    rows = list(csv.DictReader(path.open(encoding="utf-8"))) if path.exists() else []
    rows = [r for r in rows if int(r["normal_stresses"]) > 1]
    if not rows:
        return "No mixture has been sheared under two stresses yet."
    lines = ["| mixture | stress | tests | friction angle, degrees | cohesion, kPa |", "| --- | --- | --- | --- | --- |"]

    for r in rows:
        def text(name, unit):
            low, high = r[f"{name}_low_{unit}"], r[f"{name}_high_{unit}"]
            bounds = f" ({float(low):.1f} to {float(high):.1f})" if low else ""
            return f"{float(r[f'{name}_{unit}']):.1f}{bounds}"
        lines.append(f"| VRC {100 * float(r['rubber_content']):g} % | {r['quantity']} | {r['tests']} | {text('friction_angle', 'deg')} | {text('cohesion', 'kPa')} |")
    return "\n".join(lines)


def draw(tests):
    figure, axes = plt.subplots(2, 3, figsize=(12, 6.6), sharex=True, constrained_layout=True)
    panels = [("shear stress, kPa", 2, "shear_stress_kPa"), ("vertical displacement, mm (up positive)", 2, "vertical_displacement_mm"),
              ("anisotropy of the contacts, a", 3, "a_all"), ("anisotropy of the normal forces, a_n", 3, "a_n_all"),
              ("direction of the normal forces, degrees", 3, "theta_n_all_deg"), ("bulk friction", 3, "bulk_friction_all")]
    colours = dict(zip(MIXTURES, plt.get_cmap("viridis")(np.linspace(0.0, 0.92, len(MIXTURES)))))
    for axis, (title, table, column) in zip(axes.flat, panels):
        for test in tests:
            mixture, stress, *variant = test[0].split("-")
            axis.plot(test[table]["displacement_mm"], test[table][column], STYLES[stress], color=colours[mixture], lw=0.6 if variant else 1.4)
        axis.set_title(title, fontsize=10, loc="left")
        axis.grid(alpha=0.25)
    for axis in axes[1]:
        axis.set_xlabel("shear displacement, mm")
    names = [test[0].split("-") for test in tests]
    lines = [Line2D([], [], color=colours[m], label=f"VRC {int(m[3:])} %") for m in MIXTURES if any(n[0] == m for n in names)]
    lines += [Line2D([], [], color="0.3", ls=style, label=stress.lstrip("0").replace("kPa", " kPa")) for stress, style in STYLES.items()
              if any(n[1] == stress for n in names)]
    if any(len(n) > 2 for n in names):
        lines.append(Line2D([], [], color="0.3", lw=0.6, label="another seed or numbers of grains"))
    figure.legend(handles=lines, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=len(lines), frameon=False, fontsize=9)
    PICTURE.parent.mkdir(exist_ok=True)
    figure.savefig(PICTURE, dpi=110, bbox_inches="tight")


def missing_text(folder, tests):
    """Which tests of the campaign are not on record."""
    names = [test["name"] for test in read_json(folder, "campaign.json")["tests"]]
    missing = [label(name) for name in names if name not in {t[0] for t in tests}]
    if not missing:
        return f"All {len(names)} tests are on record."
    return f"**On record: {len(tests)} of {len(names)} tests.** Missing, for want of machine time: {'; '.join(missing)}."


def recorded_hash(name):
    """The hash that the page states for a test; None when the test is not on record yet."""
    for line in PAGE.read_text(encoding="utf-8").splitlines():
        if line.startswith(f"| {label(name)} |") and line.rstrip().endswith("` |"):
            return line.split("`")[1]
    return None


def main():
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("folder", type=pathlib.Path, help="of the campaign")
    folder = words.parse_args().folder
    tests = []
    for test in sorted((folder / "tests").iterdir()):
        summary = read_json(test)
        if summary is None:
            continue
        told = recorded_hash(test.name)
        if told is not None and told != summary["state_hash"]:
            sys.exit(f"{test}: ends with {summary['state_hash']}, but {told} is on record")
        tests.append((test.name, summary, read_csv(test / "shear.csv"), read_csv(test / "micro.csv")))
    if not tests:
        sys.exit(f"{folder}: no test is finished")
    lost = {file.name.removesuffix(".csv") for file in FILES.glob("*Pa*.csv") if not file.name.endswith(".micro.csv")} - {t[0] for t in tests}
    if lost:
        sys.exit(f"{folder}: lacks {', '.join(sorted(lost))}, which the page has")
    FILES.mkdir(exist_ok=True)
    for name, _, shear, micro in tests:
        write_rows(FILES / f"{name}.csv", thin(shear, CURVE, STEP))
        write_rows(FILES / f"{name}.micro.csv", thin(micro, MICRO))
    fill_page(PAGE, {"curves": curve_table(tests), "micro": micro_table(tests), "origin": origin_table(tests),
                     "strength": strength_table(folder), "missing": missing_text(folder, tests)})
    draw(tests)
    print(f"{len(tests)} tests on record")


if __name__ == "__main__":
    main()
