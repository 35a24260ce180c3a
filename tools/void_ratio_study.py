#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures which void ratios specimens reach and what the open choices do to them.

    tools/void_ratio_study.py build/release/apps/dem4grm/dem4grm FOLDER --part choices density full
    tools/void_ratio_study.py build/release/apps/dem4grm/dem4grm FOLDER --write

Prepares specimens into FOLDER; what is there is not made again, so it may be stopped at any time. --write puts the tables
between the marks of docs/results/calibration-void-ratio.md, with a picture and a CSV beside it. Needs python3-matplotlib.
"""
import argparse
import concurrent.futures
import csv
import pathlib
import subprocess
import sys

from run_files import fill_page, read_json

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/results/calibration-void-ratio.md"
TABLE = ROOT / "docs/results/calibration-void-ratio.csv"
PICTURE = ROOT / "docs/pictures/calibration-void-ratio.png"
GRADINGS = ROOT / "cases/gradings"

# Published calibration set: void ratio after compression to 30, 60 and 100 kPa.
PUBLISHED = {0: (0.534, 0.516, 0.511), 100: (0.782, 0.681, 0.598)}
STRESSES = (30, 60, 100)
BALL_VOLUME = 146.608  # of the 35 balls of a grain, r^3; solid density = 1610 * this / (solid volume / r^3)


def solid_volume(in_r3):
    return {"rubber.solid_density": f"{1610 * BALL_VOLUME / in_r3:.2f} kg/m3"}


def one_size(millimetres):
    low, high = millimetres - 0.05, millimetres + 0.05
    return {"specimen.rubber_grading": f'[["{low:.3f} mm", 0.0], ["{high:.3f} mm", 1.0]]'}


def grading(kind, name):
    return {f"specimen.{kind}_grading": f'"{GRADINGS / name}"'}


def fill(void_ratio):
    return {"specimen.generation_void_ratio": str(void_ratio)}


SEEDS = [
    ("seed", "shipped defaults, seed 1", {}),
    ("seed", "seed 2", {"seed": "2"}),
    ("seed", "seed 3", {"seed": "3"}),
]
FOR_BOTH = [
    ("path", "branches at the full stress", {"specimen.branch_stress_ratio": "1.0"}),
    ("walls", "plate friction 0.7 in preparation", {"specimen.preparation_plate_friction": "0.7"}),
    ("walls", "box of 70 x 70 x 37 mm", {"box.length": "70 mm", "box.width": "70 mm", "box.height": "37 mm"}),
]

# What is varied, one at a time, at 60 kPa in an eighth of the volume: group, label, settings.
CHOICES = {
    0: [
        *SEEDS,
        ("shapes", "spheres, generated at e 0.75", {"specimen.clump_shapes": '["sphere"]', **fill(0.75)}),
        ("shapes", "T1 only (two equal balls)", {"specimen.clump_shapes": '["T1"]'}),
        ("shapes", "T4 only (three in a row)", {"specimen.clump_shapes": '["T4"]'}),
        ("shapes", "T5 only (tetrahedron)", {"specimen.clump_shapes": '["T5"]'}),
        ("grading", "Cu 1.2", grading("gravel", "gravel-narrow.csv")),
        ("grading", "Cu 2.2", grading("gravel", "gravel-wide.csv")),
        ("path", "generated at e 0.58", fill(0.58)),
        ("path", "generated at e 0.70", fill(0.70)),
        ("path", "friction 0.3 in the fill", {"specimen.generation_friction": "0.3"}),
        *FOR_BOTH,
    ],
    100: [
        *SEEDS,
        ("size", "solid volume 203.6 r3 (72 % balls)", solid_volume(203.6)),
        ("size", "solid volume 215.5 r3 (Wigner-Seitz)", solid_volume(215.5)),
        ("size", "size 3.72 mm (r 0.631 mm)", one_size(3.72)),
        ("size", "outer cube 3.7 mm (r 0.559 mm)", one_size(3.297)),
        ("size", "sizes 2.6 to 5.0 mm (Cu 1.6)", grading("rubber", "rubber-wide.csv")),
        ("grain", "bond moments x 0.1", {"rubber.bond.moment_scale": "0.1"}),
        ("grain", "bond radius x 0.5", {"rubber.bond.radius_multiplier": "0.5"}),
        ("grain", "bond modulus 10 MPa", {"rubber.bond.modulus": "10 MPa"}),
        ("grain", "bond modulus 40 MPa", {"rubber.bond.modulus": "40 MPa"}),
        ("grain", "no linear springs", {"rubber.bond.linear_spring": "false"}),
        ("grain", "Poisson's ratio 0", {"rubber.poisson_ratio": "0"}),
        ("path", "generated at e 0.80", fill(0.80)),
        ("path", "generated at e 1.20", fill(1.20)),
        ("path", "friction 0.27 in the fill", {"specimen.generation_friction": "0.27"}),
        *FOR_BOTH,
    ],
}


class Job:
    """One specimen: where it lies and how it is made."""

    def __init__(self, part, vrc, stress, label, settings, case="cases/eighth.toml", threads=1):
        self.part, self.vrc, self.stress, self.label, self.case, self.threads = part, vrc, stress, label, case, threads
        self.settings = settings
        words = "".join(c if c.isalnum() else "-" for c in f"{part}-{vrc}-{stress}-{label}")
        self.folder = words.strip("-")

    def command(self, program, folder):
        out = [program, "specimen", ROOT / self.case, "-q", "-j", str(self.threads), "-o", folder / self.folder]
        if self.case.startswith("cases/paper"):
            out += ["--store", folder / "store"]
        values = {"specimen.rubber_content": str(self.vrc / 100), "shear.normal_stress": f"{self.stress} kPa"}
        for name, value in {**values, **self.settings}.items():
            out += ["--set", f"{name}={value}"]
        return out

    def has_failed(self, folder):
        status = read_json(folder / self.folder, "status.json")
        return status is not None and status["state"] == "failed"

    def result(self, folder):
        return read_json(folder / self.folder, "specimen.json")


def all_jobs():
    jobs = [Job("choices", vrc, 60, label, settings)
            for vrc, rows in CHOICES.items() for _, label, settings in rows]
    for vrc in (0, 25, 100):
        for stress in (30, 100):
            for seed in (1, 2):
                jobs.append(Job("density", vrc, stress, f"seed {seed}", {"seed": str(seed)}))
    for vrc in (0, 100):  # in this order: each stress begins with the states of the one before
        for stress in STRESSES:
            jobs.append(Job("full", vrc, stress, "full size", {}, "cases/paper/direct-shear.toml", threads=2))
    return jobs


def run(job, program, folder):
    if job.result(folder) is not None:
        return
    done = subprocess.run(job.command(program, folder), capture_output=True, text=True)
    failure = done.stderr.strip().splitlines()[0] if done.returncode != 0 and done.stderr.strip() else ""
    print(job.folder, failure or "done", flush=True)


def prepare(program, folder, parts):
    jobs = [j for j in all_jobs() if j.part in parts]
    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as pool:
        list(pool.map(lambda j: run(j, program, folder), [j for j in jobs if j.threads == 1]))
    for job in (j for j in jobs if j.threads > 1):
        run(job, program, folder)


COLUMNS = ("part", "vrc_percent", "stress_kPa", "label", "grains", "e_min", "e_max", "relative_density", "friction",
           "e_prepared", "e_before_shear", "height_mm", "alignment", "branches", "steps", "commit")


def row_of(job, s):
    return {"part": job.part, "vrc_percent": job.vrc, "stress_kPa": job.stress, "label": job.label,
            "grains": s["clumps"] + s["rubber_grains"], "e_min": s["void_ratio_min"], "e_max": s["void_ratio_max"],
            "relative_density": s["relative_density"], "friction": s["preparation_friction"],
            "e_prepared": s["void_ratio_prepared"], "e_before_shear": s["void_ratio_before_shear"],
            "height_mm": s["height_before_shear_mm"], "alignment": s["alignment_before_shear"],
            "branches": len(s["branches"]), "steps": s["steps"], "commit": s["commit"]}


def markdown(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + " --- |" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(r) + " |" for r in rows])


def choices_table(rows, vrc, failed):
    found = {r["label"]: r for r in rows if r["part"] == "choices" and r["vrc_percent"] == vrc}
    base = [found[label] for group, label, _ in CHOICES[vrc] if group == "seed" and label in found]
    mean = sum(r["e_prepared"] for r in base) / len(base)
    out = []
    for group, label, _ in CHOICES[vrc]:
        r = found.get(label)
        if r is None:
            if (vrc, label) in failed:
                out.append([group, label] + ["no specimen"] + ["-"] * 5)
            continue
        out.append([group, label, f"{r['e_min']:.3f}", f"{r['e_max']:.3f}", f"{r['friction']:.4f}",
                    f"{100 * r['relative_density']:.1f}", f"{r['e_prepared']:.3f}", f"{r['e_prepared'] - mean:+.3f}"])
    return markdown(["", "choice", "e_min", "e_max", "friction", "D_r %", "e at 60 kPa", "against the seeds' mean"], out)


def density_table(rows):
    out = [[f"{r['vrc_percent']}", f"{r['stress_kPa']}", r["label"], f"{r['e_min']:.4f}", f"{r['e_max']:.4f}",
            f"{100 * r['relative_density']:.1f}", f"{r['friction']:.4f}", f"{r['branches']}", f"{r['e_prepared']:.4f}"]
           for r in rows if r["part"] == "density"]
    return markdown(["VRC %", "kPa", "", "e_min", "e_max", "D_r %", "friction", "branches", "e under the stress"], out)


def full_table(rows):
    out = []
    for r in (r for r in rows if r["part"] == "full"):
        published = PUBLISHED[r["vrc_percent"]][STRESSES.index(r["stress_kPa"])]
        out.append([f"{r['vrc_percent']}", f"{r['stress_kPa']}", f"{r['grains']:,}", f"{r['e_min']:.3f}",
                    f"{r['e_max']:.3f}", f"{r['friction']:.4f}", f"{100 * r['relative_density']:.1f}",
                    f"{r['e_prepared']:.3f}", f"{published:.3f}", f"{r['e_prepared'] - published:+.3f}",
                    f"{r['height_mm']:.1f}"])
    return markdown(["VRC %", "kPa", "grains", "e_min", "e_max", "friction", "D_r %", "e", "published e", "difference",
                     "height mm"], out)


def draw(rows):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 3, figsize=(15, 7.2), gridspec_kw={"width_ratios": (1, 1.15, 1.15)})
    colours = {0: "#31475e", 100: "#c2410c"}
    names = {0: "gravel", 100: "rubber"}
    for vrc, published in PUBLISHED.items():
        axes[0].plot(STRESSES, published, "o", mfc="none", ms=9, color=colours[vrc], label=f"{names[vrc]}, published")
        full = [r for r in rows if r["part"] == "full" and r["vrc_percent"] == vrc]
        for key, style, what in (("e_max", ":", "e_max"), ("e_prepared", "-", "50 % relative density"), ("e_min", "--", "e_min")):
            axes[0].plot([r["stress_kPa"] for r in full], [r[key] for r in full], style, marker=".", color=colours[vrc],
                         label=f"{names[vrc]}, {what}")
    axes[0].set(xlabel="normal stress, kPa", ylabel="void ratio", title="Full size, shipped defaults")
    below = {"fontsize": 8, "frameon": False, "loc": "upper center", "bbox_to_anchor": (0.5, -0.09), "ncols": 2}
    axes[0].legend(**below)
    for axis, vrc in zip(axes[1:], PUBLISHED):
        found = {r["label"]: r for r in rows if r["part"] == "choices" and r["vrc_percent"] == vrc}
        labels = [label for _, label, _ in CHOICES[vrc] if label in found]
        seeds = [found[label]["e_prepared"] for group, label, _ in CHOICES[vrc] if group == "seed" and label in found]
        places = range(len(labels))
        axis.axvspan(min(seeds), max(seeds), color="#e5e7eb", label="three seeds")
        axis.axvline(PUBLISHED[vrc][1], color="#0e7490", lw=1.2, label="published")
        for place, label in zip(places, labels):
            r = found[label]
            axis.plot([r["e_min"], r["e_max"]], [place, place], color="#9ca3af", lw=1)
            axis.plot(r["e_prepared"], place, "o", color=colours[vrc])
        axis.set_yticks(list(places), labels, fontsize=8)
        axis.invert_yaxis()
        axis.set_xlabel("void ratio at 60 kPa; line: e_min to e_max at 54 kPa", fontsize=9)
        axis.set_title(f"An eighth of the volume, {names[vrc]}")
        axis.legend(**below)
    figure.tight_layout()
    figure.savefig(PICTURE, dpi=110)


def write(folder):
    rows = [row_of(job, s) for job in all_jobs() if (s := job.result(folder)) is not None]
    with open(TABLE, "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    failed = {(j.vrc, j.label) for j in all_jobs() if j.part == "choices" and j.has_failed(folder)}
    tables = {"full": full_table(rows), "density": density_table(rows), "gravel": choices_table(rows, 0, failed),
              "rubber": choices_table(rows, 100, failed)}
    fill_page(PAGE, tables)
    draw(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--part", nargs="*", choices=("choices", "density", "full"), default=[])
    parser.add_argument("--write", action="store_true", help="write tables, CSV and picture from what is in the folder")
    options = parser.parse_args()
    prepare(options.program.resolve(), options.folder.resolve(), options.part)
    if options.write:
        write(options.folder.resolve())
    return 0


if __name__ == "__main__":
    sys.exit(main())
