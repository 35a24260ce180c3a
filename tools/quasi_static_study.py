#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Shears the same specimens at the published 2 mm/s and at the velocity of an inertial number of 5e-5.

    tools/quasi_static_study.py build/release/apps/dem4grm/dem4grm FOLDER --list
    tools/quasi_static_study.py build/release/apps/dem4grm/dem4grm FOLDER --run --workers 16 --time 500
    tools/quasi_static_study.py build/release/apps/dem4grm/dem4grm FOLDER --write

For every rubber content and seed one specimen, and from it both shear tests, in FOLDER. What is finished is not made again and
what was begun goes on from its checkpoint, so --run may be stopped (SIGINT, SIGTERM, --time) and repeated at will, for all
runs or for some. Only a kill costs what was done since the last checkpoint. --write puts two CSV files beside
docs/results/quasi-static.md, draws its pictures, and fills its tables if the page is there. Needs python3-numpy, and
python3-matplotlib for --write.
"""
import argparse
import csv
import pathlib
import signal
import subprocess
import sys
import time

import numpy as np

from run_files import fill_page, read_csv, read_json

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/results/quasi-static.md"
FIGURES = ROOT / "docs/results/quasi-static.csv"
CURVES = ROOT / "docs/results/quasi-static-curves.csv"
PICTURES = ROOT / "docs/pictures"

VELOCITIES = {"published": "2 mm/s", "quasi-static": "quasi-static"}
# Friction while the plate compresses, as the search for 50 % relative density found it at full size under 100 kPa (VRC 25: in an
# eighth of the volume). Both tests of a pair have the same specimen, so its density need not be exact, and a search
# would take longer than they do.
FRICTION = {0: 0.0807, 25: 0.0909, 100: 0.1736}

# Of a test in 50 x 50 x 53 mm under 100 kPa on one thread: time of a step and time step, us; velocity, mm/s; steps of the
# specimen. Only the order of the runs and --list follow from them.
STEP, TIME_STEP, CHOSEN, STEPS_OF_SPECIMEN = (
    {0: 190.0, 25: 720.0, 100: 1600.0}, {0: 9.6, 25: 3.34, 100: 3.34}, {0: 2.8, 25: 3.3, 100: 6.0},
    {0: 32e3, 25: 49e3, 100: 78e3})

CASE = """# Made by tools/quasi_static_study.py.
name = "{name}"
seed = {seed}

[specimen]
rubber_content = {content}
{density}
gravel_grading = "{gradings}/gravel-rounded.csv"
rubber_grading = "{gradings}/rubber-3.7mm.csv"

[box]
length = "{box[0]:g} mm"
width  = "{box[1]:g} mm"
height = "{box[2]:g} mm"

[shear]
normal_stress = "{stress:g} kPa"
velocity      = "{velocity}"
displacement  = "{displacement:g} mm"

[recording]
frame_interval = "{displacement:g} mm"
extra_frames   = []
"""


class Job:
    """A specimen (velocity None) or a shear test from it."""

    def __init__(self, options, vrc, seed, velocity=None):
        self.options, self.vrc, self.seed, self.velocity = options, vrc, seed, velocity
        self.name = f"vrc{vrc:03d}-seed{seed}-{velocity or 'specimen'}"
        self.folder = options.folder / self.name
        self.specimen = None if velocity is None else Job(options, vrc, seed)
        self.process = None

    def case_text(self):
        o = self.options
        density = "relative_density = 0.5" if o.search else f"preparation_friction = {FRICTION.get(self.vrc, 0.1)}"
        return CASE.format(name=self.name, seed=self.seed, content=self.vrc / 100, density=density, box=o.box,
                           gradings=ROOT / "cases/gradings", stress=o.stress, displacement=o.displacement,
                           velocity=VELOCITIES[self.velocity or "published"])

    def start(self):
        case = self.options.folder / f"{self.name}.toml"
        case.write_text(self.case_text())
        words = [self.options.program, "run" if self.velocity else "specimen", case, "-q", "-o", self.folder,
                 "-j", str(self.options.threads)]
        if self.specimen:
            words += ["--specimen", self.specimen.folder]
        # In a session of its own: a signal to the terminal must not reach it twice, which would end it without a checkpoint.
        self.process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                        start_new_session=True)

    def result(self):
        return read_json(self.folder, "summary.json" if self.velocity else "specimen.json")

    def is_done(self):
        return self.result() is not None

    def is_ready(self):
        return self.specimen is None or self.specimen.is_done()

    def seconds(self):
        """What the whole job is expected to take on one thread."""
        known = min(STEP, key=lambda v: abs(v - self.vrc))
        volume = np.prod(self.options.box) / (50 * 50 * 53)
        steps = STEPS_OF_SPECIMEN[known]
        if self.velocity:
            velocity = 2.0 if self.velocity == "published" else CHOSEN[known]
            steps = self.options.displacement / velocity / (TIME_STEP[known] * 1e-6)
        return steps * STEP[known] * 1e-6 * volume

    def weight(self):
        """Longest first; a specimen counts with the longer test that waits for it."""
        if self.velocity:
            return self.seconds()
        return self.seconds() + Job(self.options, self.vrc, self.seed, "published").seconds()

    def state(self):
        status = read_json(self.folder, "status.json")
        if self.is_done():
            return "done"
        if status is None:
            return "not begun"
        return f"{status['state']}, {status['stage']}, {status['displacement_mm']:.2f} mm"


def all_jobs(options):
    jobs = []
    for vrc in options.vrc:
        for seed in options.seeds:
            jobs.append(Job(options, vrc, seed))
            jobs += [Job(options, vrc, seed, velocity) for velocity in options.velocities]
    return jobs


def tests_of(options):
    return [job for job in all_jobs(options) if job.velocity]


def run(options):
    """Keeps so many processes going until all jobs are done or the time is over. 0, 75 when jobs are left, 1 after a failure."""
    options.folder.mkdir(parents=True, exist_ok=True)
    waiting = sorted((j for j in all_jobs(options) if not j.is_done()), key=Job.weight, reverse=True)
    running, end, is_stopping, failures = [], time.monotonic() + options.time, False, 0
    stop_signals = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda got, frame: stop_signals.append(got))
    while running or (waiting and not is_stopping):
        if not is_stopping and (stop_signals or time.monotonic() > end):
            is_stopping = True
            print(f"stopping {len(running)} runs; the same command goes on", flush=True)
            for job in running:
                job.process.terminate()
        while not is_stopping and len(running) < options.workers:
            job = next((j for j in waiting if j.is_ready()), None)
            if job is None:
                break
            waiting.remove(job)
            job.start()
            running.append(job)
        for job in [j for j in running if j.process.poll() is not None]:
            running.remove(job)
            code, text = job.process.returncode, job.process.stderr.read().strip()
            failures += code not in (0, 75)
            print(job.name, "done" if code == 0 else text.splitlines()[0] if text else f"exit code {code}", flush=True)
        if not running and not is_stopping and waiting and not any(j.is_ready() for j in waiting):
            break  # the specimens that they wait for have failed
        time.sleep(0.2)
    left = [j.name for j in all_jobs(options) if not j.is_done()]
    print(f"{len(left)} of {len(all_jobs(options))} jobs are not done" if left else "all done")
    return 1 if failures else 75 if left else 0


def show(options):
    total = 0.0
    for job in all_jobs(options):
        total += 0.0 if job.is_done() else job.seconds()
        print(f"{job.name:28} {job.seconds():6.0f} s  {job.state()}")
    print(f"{total:.0f} s of one processor left, by the times that this script knows")


# ---- what came out

FIGURE_COLUMNS = (
    "shear_velocity_mm_per_s", "inertial_number_max", "void_ratio_before_shear", "height_before_shear_mm",
    "shear_displacement_mm", "normal_stress_mean_kPa", "peak_shear_stress_kPa", "displacement_at_peak_mm",
    "residual_shear_stress_kPa", "secant_stiffness_kPa_per_mm", "dilation_angle_deg", "vertical_displacement_at_end_mm",
    "void_ratio_at_end", "unbalanced_ratio_mean", "energy_closure_per_cent", "steps", "wall_time_s", "threads", "state_hash",
    "commit")
CURVE_COLUMNS = {"a": "a_all", "theta_a_deg": "theta_a_all_deg", "a_n": "a_n_all", "theta_n_deg": "theta_n_all_deg",
                 "bulk_friction": "bulk_friction_all", "sliding": "sliding_all", "coordination": "coordination",
                 "strong_fraction": "strong_fraction", "strong_gg": "strong_share_gg", "strong_gr": "strong_share_gr",
                 "strong_rr": "strong_share_rr", "strong_load_gg": "strong_load_share_gg",
                 "strong_load_gr": "strong_load_share_gr", "strong_load_rr": "strong_load_share_rr"}
STRESS, HEIGHT, WINDOW = "shear_stress_kPa", "vertical_displacement_mm", 0.1  # mm to either side of a mark


def curves_of(job):
    """Values at the displacements of micro.csv; shear stress and height as means over 0.2 mm about them."""
    shear, micro = read_csv(job.folder / "shear.csv"), read_csv(job.folder / "micro.csv")
    u, marks = shear["displacement_mm"], micro["displacement_mm"]
    out = {"displacement_mm": marks}
    for name in (STRESS, HEIGHT):
        means = [shear[name][np.abs(u - m) <= WINDOW + 1e-9].mean() for m in marks[1:]]
        out[name] = np.array([0.0] + means)
    return out | {name: micro[column] for name, column in CURVE_COLUMNS.items()}


def kept_rows(path, jobs):
    """Rows of other rubber contents, which were made before and elsewhere."""
    made = {str(job.vrc) for job in jobs}
    if not path.exists():
        return []
    with open(path, newline="") as file:
        return [row for row in list(csv.reader(file))[1:] if row[0] not in made]


def write_tables(jobs):
    key = ("vrc_percent", "seed", "velocity")
    figures, others = kept_rows(FIGURES, jobs), kept_rows(CURVES, jobs)
    with open(FIGURES, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(key + FIGURE_COLUMNS)
        writer.writerows(figures)
        writer.writerows([job.vrc, job.seed, job.velocity] + [job.result()[name] for name in FIGURE_COLUMNS] for job in jobs)
    with open(CURVES, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        curves = [(job, curves_of(job)) for job in jobs]
        writer.writerow(key + tuple(curves[0][1]))
        writer.writerows(others)
        for job, columns in curves:
            writer.writerows([job.vrc, job.seed, job.velocity] + [f"{v:.5g}" for v in row] for row in zip(*columns.values()))


def read_tables():
    """{vrc: {velocity: {seed: row or columns}}} of both files."""
    figures, curves = {}, {}
    with open(FIGURES, newline="") as file:
        for row in csv.DictReader(file):
            by = figures.setdefault(int(row["vrc_percent"]), {}).setdefault(row["velocity"], {})
            by[int(row["seed"])] = row
    with open(CURVES, newline="") as file:
        for row in csv.DictReader(file):
            by = curves.setdefault(int(row["vrc_percent"]), {}).setdefault(row["velocity"], {})
            columns = by.setdefault(int(row["seed"]), {})
            for name in list(row)[3:]:
                columns.setdefault(name, []).append(float(row[name]))
    for by_velocity in curves.values():
        for by_seed in by_velocity.values():
            for columns in by_seed.values():
                for name, values in columns.items():
                    values = np.array(values)
                    # Axes are known modulo 180 degrees; those of sheared specimens lie about 45.
                    columns[name] = (values + 45) % 180 - 45 if name.startswith("theta") else values
    return figures, curves


def pairs_of(by_velocity):
    """Seeds that have both tests, ascending."""
    return sorted(set(by_velocity.get("published", {})) & set(by_velocity.get("quasi-static", {})))


def stack(by_velocity, velocity, seeds, name):
    """[seed, mark], as long as the shortest of all tests."""
    n = min(len(by_velocity[v][s][name]) for v in VELOCITIES for s in seeds)
    return np.array([by_velocity[velocity][s][name][:n] for s in seeds])


PANELS = ((STRESS, "shear stress, kPa"), (HEIGHT, "vertical displacement, mm"), ("a_n", "normal force a_n"),
          ("a", "fabric a"), ("theta_n_deg", "theta_n, degrees"), ("strong", "strong contacts by number"))
COLOURS = {"published": "#31475e", "quasi-static": "#c2410c"}
PURE = (0, 100)  # rubber contents with one kind of contact


def strong_columns(vrc):
    """At VRC 0 and 100 all strong contacts are of one kind: their share of all contacts is told."""
    return ["strong_fraction"] if vrc in PURE else ["strong_gg", "strong_gr", "strong_rr"]


def draw(curves):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    size = {"figsize": (4.6 * len(curves), 15), "layout": "constrained", "squeeze": False, "sharex": "col"}
    figure, axes = plt.subplots(len(PANELS), len(curves), **size)
    differences, rows = plt.subplots(len(PANELS), len(curves), **size)
    for column, (vrc, by_velocity) in enumerate(sorted(curves.items())):
        seeds = pairs_of(by_velocity)
        axes[0][column].set_title(f"VRC {vrc} %")
        rows[0][column].set_title(f"VRC {vrc} %")
        for k, (panel, title) in enumerate(PANELS):
            names = strong_columns(vrc) if panel == "strong" else [panel]
            for name, style in zip(names, ("-", "--", ":")):
                draw_curves(axes[k][column], by_velocity, seeds, name, style)
                draw_difference(rows[k][column], by_velocity, seeds, name, style)
            label = title if panel != "strong" or vrc not in PURE else "strong contacts of all"
            axes[k][column].set_ylabel(label, fontsize=9)
            rows[k][column].set_ylabel("difference in " + label, fontsize=9)
        for grid in (axes, rows):
            grid[-1][column].set_xlabel("shear displacement, mm", fontsize=9)
            grid[-1][column].set_xlim(left=0)
    axes[0][0].legend(fontsize=8, frameon=False)
    rows[0][0].legend(fontsize=8, frameon=False)
    figure.savefig(PICTURES / "quasi-static-curves.png", dpi=90)
    differences.savefig(PICTURES / "quasi-static-differences.png", dpi=90)


def draw_curves(axis, by_velocity, seeds, name, style):
    for velocity, colour in COLOURS.items():
        values = stack(by_velocity, velocity, seeds, name)
        u = by_velocity[velocity][seeds[0]]["displacement_mm"][:values.shape[1]]
        axis.fill_between(u, values.min(axis=0), values.max(axis=0), color=colour, alpha=0.18, lw=0)
        label = f"{'2 mm/s' if velocity == 'published' else 'quasi-static'}, mean and range of {len(seeds)} seeds"
        axis.plot(u, values.mean(axis=0), style, color=colour, lw=1.2, label=label if style == "-" else None)


def draw_difference(axis, by_velocity, seeds, name, style):
    slow = stack(by_velocity, "published", seeds, name)
    difference = stack(by_velocity, "quasi-static", seeds, name) - slow
    u = by_velocity["published"][seeds[0]]["displacement_mm"][:slow.shape[1]]
    if style == "-":
        scatter = slow.std(axis=0, ddof=1) if len(seeds) > 1 else np.zeros_like(u)
        axis.fill_between(u, -scatter, scatter, color="#e5e7eb", lw=0, label="standard deviation of the seeds at 2 mm/s")
        axis.axhline(0, color="#9ca3af", lw=0.8)
    for k, row in enumerate(difference):
        axis.plot(u, row, style, color="#0e7490", lw=0.6, alpha=0.7, label="each specimen" if style == "-" and k == 0 else None)
    axis.plot(u, difference.mean(axis=0), style, color="#c2410c", lw=1.4, label="mean" if style == "-" else None)


# Name, key, unit, digits of the table; keys of curves are means over all displacements from 1 mm on.
FIGURE_ROWS = (("peak shear stress", "peak_shear_stress_kPa", "kPa", 1), ("mean of the last 2 mm", "residual_shear_stress_kPa", "kPa", 1),
               ("dilation angle", "dilation_angle_deg", "degrees", 1),
               ("vertical displacement at the end", "vertical_displacement_at_end_mm", "mm", 3))
CURVE_ROWS = (("shear stress", STRESS, "kPa", 2), ("a_n", "a_n", "", 3), ("a", "a", "", 3), ("theta_n", "theta_n_deg", "degrees", 1),
              ("bulk friction", "bulk_friction", "", 3), ("strong contacts of all", "strong_fraction", "", 3),
              ("strong g-g", "strong_gg", "", 3), ("strong g-r", "strong_gr", "", 3), ("strong r-r", "strong_rr", "", 3))


def difference_row(vrc, name, unit, digits, slow, fast):
    """One line of the table: means, mean difference of the pairs with its standard error, scatter of the seeds."""
    difference, n = fast - slow, len(slow)
    scatter = slow.std(ddof=1) if n > 1 else np.nan
    error = difference.std(ddof=1) / np.sqrt(n) if n > 1 else np.nan
    texts = [f"{v:.{digits}f}" for v in (slow.mean(), fast.mean())]
    ratio = f"{abs(difference.mean()) / scatter:.1f}" if scatter > 0 else "-"
    return [f"{vrc}", name + (f", {unit}" if unit else ""), *texts, f"{difference.mean():+.{digits}f} +- {error:.{digits}f}",
            f"{scatter:.{digits}f}", ratio]


def difference_table(figures, curves):
    rows = []
    for vrc in sorted(figures):
        seeds = pairs_of(figures[vrc])
        for name, key, unit, digits in FIGURE_ROWS:
            if any(figures[vrc][v][s][key] == "" for v in VELOCITIES for s in seeds):
                continue  # the tests are shorter than this needs
            slow, fast = (np.array([float(figures[vrc][v][s][key]) for s in seeds]) for v in VELOCITIES)
            rows.append(difference_row(vrc, name, unit, digits, slow, fast))
        for name, key, unit, digits in CURVE_ROWS:
            if key[-3:] in ("_gg", "_gr", "_rr") and vrc in PURE:
                continue
            u = stack(curves[vrc], "published", seeds, "displacement_mm")[0]
            slow, fast = (stack(curves[vrc], v, seeds, key)[:, u > 0.99].mean(axis=1) for v in VELOCITIES)
            rows.append(difference_row(vrc, "mean " + name, unit, digits, slow, fast))
    head = ["VRC %", "", "2 mm/s", "quasi-static", "difference of a pair", "scatter of seeds", "difference over scatter"]
    return markdown(head, rows)


def cost_table(figures):
    rows = []
    for vrc in sorted(figures):
        for velocity in VELOCITIES:
            for seed, row in sorted(figures[vrc].get(velocity, {}).items()):
                rows.append([f"{vrc}", f"{seed}", velocity, f"{float(row['shear_velocity_mm_per_s']):g}",
                             f"{float(row['inertial_number_max']):.2e}", f"{float(row['void_ratio_before_shear']):.3f}",
                             f"{float(row['height_before_shear_mm']):.1f}", f"{int(row['steps']):,}",
                             f"{float(row['wall_time_s']):.0f}", f"{float(row['energy_closure_per_cent']):+.2f}"])
    return markdown(["VRC %", "seed", "velocity", "mm/s", "inertial number at most", "e before shear", "height mm",
                     "steps, specimen included", "wall time s", "energy not accounted for %"], rows)


def markdown(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + " --- |" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(r) + " |" for r in rows])


def write(options):
    jobs = [job for job in tests_of(options) if job.is_done()]
    if jobs:
        write_tables(jobs)
    figures, curves = read_tables()
    figures, curves = ({vrc: d[vrc] for vrc in d if pairs_of(d[vrc])} for d in (figures, curves))
    draw(curves)
    tables = {"differences": difference_table(figures, curves), "runs": cost_table(figures)}
    if not PAGE.exists():
        print("\n\n".join(tables.values()))
        return
    fill_page(PAGE, tables)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--run", action="store_true", help="make specimens and tests")
    parser.add_argument("--list", action="store_true", help="what there is to do, how long it may take, and where it stands")
    parser.add_argument("--write", action="store_true", help="write CSV, pictures and tables from what is in the folder")
    parser.add_argument("--vrc", type=int, nargs="+", default=[0, 25, 100], help="rubber contents, per cent")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--velocities", nargs="+", choices=VELOCITIES, default=list(VELOCITIES))
    parser.add_argument("--displacement", type=float, default=6.0, help="mm")
    parser.add_argument("--box", type=float, nargs=3, default=[50, 50, 53], help="length, width, height, mm")
    parser.add_argument("--stress", type=float, default=100.0, help="normal stress, kPa")
    parser.add_argument("--search", action="store_true", help="search for 50 %% relative density in place of a known friction")
    parser.add_argument("--workers", type=int, default=2, help="processes at a time")
    parser.add_argument("--threads", type=int, default=1, help="of each process")
    parser.add_argument("--time", type=float, default=1e9, help="s, then every run stops with a checkpoint")
    options = parser.parse_args()
    options.program, options.folder = options.program.resolve(), options.folder.resolve()
    code = run(options) if options.run else 0
    if options.list:
        show(options)
    if options.write:
        write(options)
    return code


if __name__ == "__main__":
    sys.exit(main())
