#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the micro-mechanics of a direct shear run: `tools/plot_micro.py runs/quick [-o picture.png] [--at 0 0.2 8 14]`.

Polar histograms of contacts, normal and tangential forces with their fitted curves at some stored states; the tangential
force twice: its magnitude, and with its sign in the shear plane (red turns the pair against the clock). Then anisotropy,
directions and the composition of the strong network against displacement. An example of how to read results.h5: the
histograms are made here from the stored contacts, by the formulas of docs/theory/micro-mechanics.md and without the program;
the lines that are printed must agree with `dem4grm micro`. Needs python3-h5py and python3-matplotlib.
"""
import argparse
import pathlib
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from run_files import read_csv

FILL, LINE = "#b9a27f", "#31475e"
POSITIVE, NEGATIVE = "#c2410c", "#0e7490"  # signs of the tangential force
PAIRS = {"gg": ("gravel-gravel", "#c2410c"), "gr": ("gravel-rubber", "#7c3aed"), "rr": ("rubber-rubber", "#0e7490")}
HALF = 18  # bins of 10 degrees on the half circle
WIDTH = np.pi / HALF
CENTRES = (np.arange(HALF) + 0.5) * WIDTH


def fit(values, has_value, k):
    """Mean, amplitude (bin width divided out) and direction (rad) of the k-th harmonic; least squares where bins lack."""
    basis = np.c_[np.ones(HALF), np.cos(k * CENTRES), np.sin(k * CENTRES)][has_value]
    if np.linalg.matrix_rank(basis) < 3:
        return np.nan, np.nan, np.nan
    mean, c, s = np.linalg.lstsq(basis, values[has_value], rcond=None)[0]
    damping = np.sin(k * WIDTH / 2) / (k * WIDTH / 2)
    return mean, np.hypot(c, s) / mean / damping, (np.arctan2(s, c) / k) % (2 * np.pi / k)


def histograms(frame):
    """Of each of E, f_n and f_t in the shear plane: bins of the half circle, order of the harmonic, unit."""
    contacts = frame["contacts"]
    between = contacts["wall"][:] < 0  # contacts with walls are no part of it
    normal = contacts["normal"][:][between]
    angle = np.arctan2(normal[:, 2], normal[:, 0]) % np.pi
    bins = np.minimum((angle / WIDTH).astype(int), HALF - 1)
    count = np.bincount(bins, minlength=HALF)
    mean = lambda force: np.bincount(bins, force, HALF) / np.maximum(count, 1)
    full = np.ones(HALF, dtype=bool)
    return {"contacts E, 1/rad": (count / (2 * count.sum() * WIDTH), full, 2),
            "normal force, N": (mean(contacts["normal_force"][:][between]), count > 0, 2),
            "tangential force, N": (mean(np.linalg.norm(contacts["shear_force"][:][between], axis=1)), count > 0, 4)}


def signed_shear(frame):
    """Means over the bins of the tangential force of i on j in the shear plane (N), and of the normal force (N)."""
    contacts = frame["contacts"]
    between = contacts["wall"][:] < 0
    normal, force = contacts["normal"][:][between], -contacts["shear_force"][:][between]
    angle = np.arctan2(normal[:, 2], normal[:, 0])
    # Seen from the other side normal and force turn round, and so does the direction across: the product stays.
    along = force[:, 2] * np.cos(angle) - force[:, 0] * np.sin(angle)
    bins = np.minimum((angle % np.pi / WIDTH).astype(int), HALF - 1)
    count = np.bincount(bins, minlength=HALF)
    mean = lambda values: np.bincount(bins, values, HALF) / np.maximum(count, 1)
    return mean(along), mean(contacts["normal_force"][:][between]), count > 0


def fit_signed(values, normal, has_value):
    """a_s over the mean normal force and theta_s (rad) of -f_n0 a_s sin 2(theta - theta_s)."""
    basis = np.c_[np.ones(HALF), np.cos(2 * CENTRES), np.sin(2 * CENTRES)][has_value]
    if np.linalg.matrix_rank(basis) < 3:
        return np.nan, np.nan, np.nan
    _, c, s = np.linalg.lstsq(basis, values[has_value], rcond=None)[0]
    unit = fit(normal, has_value, 2)[0]
    return unit, np.hypot(c, s) / unit / (np.sin(WIDTH) / WIDTH), (np.arctan2(c, -s) / 2) % np.pi


def draw_signed(axes, values, curve, title):
    colours = [POSITIVE if v > 0 else NEGATIVE for v in values]
    axes.bar(np.concatenate([CENTRES, CENTRES + np.pi]), np.tile(np.abs(values), 2), width=WIDTH, color=colours * 2,
             edgecolor="white", lw=0.4)
    unit, amplitude, direction = curve
    theta = np.linspace(0, 2 * np.pi, 361)
    axes.plot(theta, np.abs(unit * amplitude * np.sin(2 * (theta - direction))), color=LINE, lw=1.4)
    dress(axes, title)


def draw_polar(axes, values, curve, k, title):
    both = np.concatenate([CENTRES, CENTRES + np.pi])
    axes.bar(both, np.tile(values, 2), width=WIDTH, color=FILL, edgecolor="white", lw=0.4)
    mean, amplitude, direction = curve
    theta = np.linspace(0, 2 * np.pi, 361)
    axes.plot(theta, mean * (1 + amplitude * np.cos(k * (theta - direction))), color=LINE, lw=1.4)
    dress(axes, title)


def dress(axes, title):
    axes.set_yticklabels([])
    axes.set_xticks(np.radians([0, 90, 180, 270]))
    axes.tick_params(labelsize=7, pad=-2)
    axes.set_title(title, fontsize=8)


def chosen_frames(results, wanted):
    frames = sorted((results["frames"][k] for k in results["frames"]), key=lambda f: f.attrs["displacement"])
    at = np.array([f.attrs["displacement"] * 1e3 for f in frames])
    numbers = sorted({int(np.abs(at - w).argmin()) for w in wanted})
    return [frames[n] for n in numbers]


def draw_states(figure, frames):
    for column, frame in enumerate(frames):
        words = [f"{frame.attrs['displacement'] * 1e3:.3f} mm"]
        for row, (name, (values, has_value, k)) in enumerate(histograms(frame).items()):
            curve = fit(values, has_value, k)
            letter = "ant"[row]
            text = f"{letter if row == 0 else 'a_' + letter} {curve[1]:.4f}, theta_{letter} {np.degrees(curve[2]):.3f} deg"
            words.append(text)
            axes = figure.add_subplot(4, len(frames), row * len(frames) + column + 1, projection="polar")
            head = f"{words[0]}\n" if row == 0 else ""
            draw_polar(axes, values, curve, k, f"{head}{name}\n{text}")
        values, normal, has_value = signed_shear(frame)
        curve = fit_signed(values, normal, has_value)
        text = f"a_s {curve[1]:.4f}, theta_s {np.degrees(curve[2]):.3f} deg"
        words.append(text)
        axes = figure.add_subplot(4, len(frames), 3 * len(frames) + column + 1, projection="polar")
        draw_signed(axes, values, curve, f"signed tangential force, N\n{text}")
        print("; ".join(words))


def draw_records(figure, rows):
    u = rows["displacement_mm"]
    panels = [figure.add_subplot(1, 3, 1 + k) for k in range(3)]
    for name, label, colour in (("a_all", "a", "#c2410c"), ("a_n_all", "a_n", LINE), ("a_t_all", "a_t", "#0e7490"),
                                ("a_s_all", "a_s", "#7c3aed")):
        panels[0].plot(u, rows[name], color=colour, label=label)
    panels[0].plot(u, rows["a_noise_all"], color="grey", lw=0.7, ls=":", label="noise of a")
    panels[0].set_ylabel("anisotropy")
    for name, label, colour in (("theta_a_all_deg", "contacts", "#c2410c"), ("theta_n_all_deg", "normal force", LINE),
                                ("stress_direction_deg", "stress", "grey")):
        panels[1].plot(u, rows[name], color=colour, label=label)
    panels[1].set_ylabel("major axis, degrees")
    panels[2].stackplot(u, *(np.nan_to_num(rows[f"strong_share_{k}"]) for k in PAIRS), colors=[c for _, c in PAIRS.values()],
                        labels=[n for n, _ in PAIRS.values()], alpha=0.8)
    panels[2].set(ylabel="share of the strong contacts", ylim=(0, 1))
    for axes in panels:
        axes.set_xlabel("shear displacement, mm")
        axes.set_xlim(0, max(u[-1], 1e-3))
        axes.legend(fontsize=7, frameon=False)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, help="output folder of a direct shear run")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="picture to write (default: FOLDER/micro.png)")
    parser.add_argument("--at", type=float, nargs="+", default=[0, 0.2, 8, 14], metavar="MM",
                        help="displacements, mm; the nearest stored states are drawn")
    options = parser.parse_args()
    for name in ("micro.csv", "results.h5"):
        if not (options.folder / name).exists():
            print(f"{options.folder}: has no {name}; it is no output folder of a direct shear run", file=sys.stderr)
            return 66
    figure = plt.figure(figsize=(12, 17), layout="constrained")
    upper, lower = figure.subfigures(2, 1, height_ratios=(4, 1))
    with h5py.File(options.folder / "results.h5") as results:
        if not results["frames"]:
            print(f"{options.folder}: results.h5 holds no state yet", file=sys.stderr)
            return 66
        draw_states(upper, chosen_frames(results, options.at))
    draw_records(lower, read_csv(options.folder / "micro.csv"))
    target = options.output or options.folder / "micro.png"
    figure.savefig(target, dpi=110)
    print(target)
    return 0


if __name__ == "__main__":
    sys.exit(main())
