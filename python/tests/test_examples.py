# SPDX-License-Identifier: BSD-3-Clause
"""The four examples of tests of one's own: each under 60 lines, each against what is known of its result."""
import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path

import dem4grm
import pytest
import tiny

FOLDER = Path(__file__).resolve().parent.parent / "examples"


def load(name):
    spec = importlib.util.spec_from_file_location(name, FOLDER / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("name", ["impact", "oedometer", "triaxial", "hopper"])
def test_is_short(name):
    assert len((FOLDER / f"{name}.py").read_text(encoding="utf-8").splitlines()) < 60


def test_impact_is_that_of_hertz():
    """Overlap and duration by the closed form; the scheme has a second order in the step, 1/2000 of the duration."""
    example = load("impact")
    overlap, duration = example.hertz()
    course = example.impact()
    touching = course[course["overlap"] > 0]
    print("overlap", course["overlap"].max() / overlap - 1, "duration", (touching["time"].max() - touching["time"].min()) / duration)
    assert course["overlap"].max() == pytest.approx(overlap, rel=1e-4)
    assert touching["time"].max() - touching["time"].min() == pytest.approx(duration, rel=0.01)  # rows of ten steps
    stiffness = 4 / 3 * example.GLASS.shear_modulus / (1 - example.GLASS.poisson_ratio) * (example.RADIUS / 2) ** 0.5
    top = touching.loc[touching["overlap"].idxmax()]
    assert top["force"] == pytest.approx(stiffness * top["overlap"] ** 1.5, rel=1e-3)
    assert course["speed"].iloc[-1] == pytest.approx(example.SPEED, rel=1e-4)  # restitution 1
    assert course["energy"].iloc[-1] == pytest.approx(course["energy"].iloc[0], rel=1e-3)


@pytest.mark.parametrize("wanted", [0.9, 0.5])
def test_impact_has_the_restitution_of_its_dashpot(wanted):
    """Tsuji's relation is exact for a dashpot that may pull at the end, as this one does."""
    example = load("impact")
    assert example.impact(wanted)["speed"].iloc[-1] / example.SPEED == pytest.approx(wanted, rel=1e-3)


def test_oedometer_has_stiffness_and_lateral_stress_of_the_closed_form():
    curve = load("oedometer").oedometer()
    start = curve["height"].iloc[0]
    print((curve["height"] / curve["height_of_form"] - 1).abs().max(), (curve["side"] / curve["side_of_form"] - 1).abs().max())
    assert (start - curve["height"].iloc[-1]) / start > 0.05  # it is compressed a good deal
    assert (curve["height"] / curve["height_of_form"] - 1).abs().max() < 1e-7
    assert (curve["side"] / curve["side_of_form"] - 1).abs().max() < 1e-5


def test_triaxial_box_holds_its_pressure_and_its_stress_is_that_of_the_contacts():
    """Walls and contacts must agree (Love, Weber) up to what is out of balance. Strength: smooth walls and 216 balls with friction
    0.5; published values of loose spheres lie at 20 to 30 degrees (Thornton 2000)."""
    example = load("triaxial")
    curve, sim = example.triaxial()
    lateral = curve["mean_stress"] - curve["deviator"] / 3
    print("lateral stress off by", (lateral / example.PRESSURE - 1).abs().max(), "q/p", (curve["deviator"] / curve["mean_stress"]).max())
    assert (lateral / example.PRESSURE - 1).abs().mean() < 0.02
    late = (curve["deviator"] / curve["mean_stress"]).tail(30).mean()
    assert 0.75 < late < 1.2  # sin phi = 3 (q/p) / (6 + q/p): 20 to 30 degrees
    contacts, walls = sim.contacts, sim.wall_contacts
    force = [part["normal"] * part["normal_force"][:, None] - part["shear_force"] for part in (contacts, walls)]
    length = [(sim.walls["+" + axis].position - sim.walls["-" + axis].position)["xyz".index(axis)] for axis in "xyz"]
    volume = length[0] * length[1] * length[2]
    to_wall = walls["point"] - sim.positions[walls["body"]]
    stress = dem4grm.micro.stress_tensor(force[0], contacts["branch"], volume) + dem4grm.micro.stress_tensor(force[1], to_wall, volume)
    on_wall = sim.walls["+z"].normal_force / (length[0] * length[1])
    print("contacts", stress.diagonal(), "top wall", on_wall)
    assert stress[2, 2] == pytest.approx(on_wall, rel=0.05) and stress[0, 0] == pytest.approx(example.PRESSURE, rel=0.05)


def test_hopper_carries_the_weight_and_empties():
    curve, sim = load("hopper").hopper()
    filled = curve[curve["phase"] == "filling"]
    print("carried", filled["carried"].tail(5).mean())
    assert filled["left"].max() == 0.0
    assert filled["carried"].tail(5).mean() == pytest.approx(1.0, abs=0.03)
    assert curve["left"].is_monotonic_increasing and curve["left"].iloc[-1] > 0.9
    assert len(sim.rubber_balls) == 24


def test_an_example_draws_its_picture(tmp_path):
    subprocess.run([sys.executable, FOLDER / "oedometer.py"], cwd=tmp_path, check=True, env={**os.environ, "MPLBACKEND": "agg"})
    assert (tmp_path / "oedometer.png").stat().st_size > 10_000


def test_how_to_runs_from_the_first_line_to_the_picture(tmp_path):
    """Every block of Python of docs/how-to/python.md in one process, with the tiny case in place of the demo."""
    page = (FOLDER.parent.parent / "docs" / "how-to" / "python.md").read_text(encoding="utf-8")
    code = "\n".join(re.findall(r"^```python\n(.*?)^```", page, re.M | re.S))
    (tmp_path / "cases").mkdir()
    (tmp_path / "cases" / "quick.toml").write_text(tiny.TEXT, encoding="utf-8")
    (tmp_path / "page.py").write_text(code, encoding="utf-8")
    environment = {**os.environ, "MPLBACKEND": "agg", "OMP_NUM_THREADS": "1"}
    answer = subprocess.run([sys.executable, "page.py"], cwd=tmp_path, check=False, env=environment, capture_output=True, text=True)
    print(answer.stdout, answer.stderr)
    assert answer.returncode == 0 and "100000.0" in answer.stdout
    assert (tmp_path / "shear.png").exists() and (tmp_path / "state.h5").exists()
