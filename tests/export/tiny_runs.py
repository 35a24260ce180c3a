# SPDX-License-Identifier: BSD-3-Clause
"""Output folders of tests that take a second, made by the program as a user would make them."""
import csv
import json
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]


def tiny_case():
    """The case of the C++ tests: 137 clumps and 23 rubber grains."""
    header = (ROOT / "tests/support/command_line.hpp").read_text(encoding="utf-8")
    return re.search(r'k_tiny_case = R"\((.*?)\)"', header, re.S).group(1)


def call(program, *words, folder):
    """Runs the program with these words in a folder; returns what it said on stdout."""
    done = subprocess.run([program, *map(str, words)], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, words))} ended with {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def run_tiny(program, folder, name="shear", *more):
    (folder / "tiny.toml").write_text(tiny_case(), encoding="utf-8")
    call(program, "run", "tiny.toml", "-o", name, "-q", "-j", "1", *more, folder=folder)
    return folder / name


def run_grain(program, folder):
    case = ROOT / "cases/grain_compression.toml"
    call(program, "run", case, "-o", "grain", "-q", "-j", "1", "--set", "compression.strain=0.1", folder=folder)
    return folder / "grain"


def run_study(program, folder):
    """Two mixtures under two stresses, collected."""
    base = tiny_case().replace('displacement  = "1 mm"', 'displacement  = "0.3 mm"')
    (folder / "base.toml").write_text(base, encoding="utf-8")
    (folder / "study.toml").write_text('name = "study"\nbase = "base.toml"\n[axes]\nrubber_content = [0, 0.2]\n'
                                       'normal_stress = ["50 kPa", "100 kPa"]\n', encoding="utf-8")
    call(program, "campaign", "run", "study.toml", "-o", "study", "-w", "2", "-j", "1", folder=folder)
    call(program, "campaign", "collect", "study", folder=folder)
    return folder / "study"


def numbers_of(program, folder, name, at):
    """Fabric, normal and tangential force of a state as `dem4grm micro` finds them, in the words of the examples."""
    answer = json.loads(call(program, "micro", name, "--at", f"{at}mm", "--json", folder=folder))
    every = answer["sets"]["all"]
    pairs = (("a", "theta_a_deg"), ("a_n", "theta_n_deg"), ("a_t", "theta_t_deg"))
    return "; ".join([f"{answer['displacement_mm']:.2f} mm"] + [f"{every[a]:.4f} at {every[t]:.2f} degrees" for a, t in pairs])


def peak_line(folder, name):
    facts = json.loads((folder / name / "summary.json").read_text(encoding="utf-8"))
    return f"{name}: peak {facts['peak_shear_stress_kPa']:.1f} kPa at {facts['displacement_at_peak_mm']:.2f} mm"


def envelope_lines(folder, quantity="peak"):
    """What the examples say of the envelopes, from envelopes.csv."""
    with open(folder / "study/collected/envelopes.csv", newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["quantity"] == quantity]
    return [f"{quantity}, VRC {100 * float(r['rubber_content']):.0f} %: phi {float(r['friction_angle_deg']):.2f} degrees, "
            f"c {float(r['cohesion_kPa']):.2f} kPa" for r in rows]
