# SPDX-License-Identifier: BSD-3-Clause
"""The calibration desk: hidden parameters of a rubber grain are found again, a kill changes nothing, intervals cover the truth."""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy
import pytest
import tiny

import dem4grm
from dem4grm.calibration.data import CURVES, NUMBERS, Series, errors_of, read_curve, thinned
from dem4grm.calibration.trials import StopOf, run_elsewhere, run_program

CASES = Path(__file__).resolve().parents[2] / "cases"
COARSE = {"compression.records": 20, "compression.strain": 0.2, "compression.plate_velocity": "40 mm/s"}
TRUTH = {"rubber.bond.modulus": 17.0, "rubber.shear_modulus": 14.0, "rubber.bond.stiffness_ratio": 3.2}
STAGE = f"""seed = 5
[[stage]]
name = "rubber grain"
case = "{CASES}/grain_compression.toml"
trials = 32
start = 20
[stage.set]
"compression.records" = 20
"compression.strain" = 0.2
"compression.plate_velocity" = "40 mm/s"
"""
PARAMETERS = """[[stage.parameter]]
key = "rubber.bond.modulus"
low = "8 MPa"
high = "60 MPa"
scale = "log"
[[stage.parameter]]
key = "rubber.shear_modulus"
low = "4 MPa"
high = "40 MPa"
scale = "log"
[[stage.parameter]]
key = "rubber.bond.stiffness_ratio"
low = 1.5
high = 9.0
scale = "log"
[[stage.parameter]]
key = "walls.shear_modulus"
low = "40 GPa"
high = "160 GPa"
"""
DATA = """[[stage.data]]
file = "grain.csv"
quantity = "load_N"
x = "strain"
x_column = "Strain"
y_column = "Load"
x_factor = 0.01
error = ["1 %", 0.02]
[[stage.data]]
file = "grain.csv"
quantity = "poisson_ratio"
x = "strain"
x_column = "Strain"
y_column = "Poisson"
x_factor = 0.01
error = 0.004
"""


def write_laboratory(folder):
    """A file as a testing machine exports it: semicolons, decimal commas, a line of units, noise of the size that the desk states."""
    hidden = {"rubber.bond.modulus": "17 MPa", "rubber.shear_modulus": "14 MPa", "rubber.bond.stiffness_ratio": 3.2}
    case = dem4grm.Case.read(CASES / "grain_compression.toml", {**COARSE, **hidden})
    curve = dem4grm.run(case, folder / "hidden", threads=1, message=None).compression
    noise = numpy.random.default_rng(11).standard_normal((2, len(curve)))
    load = curve.load_N * (1.0 + 0.01 * noise[0])
    poisson = curve.poisson_ratio + 0.004 * noise[1]
    rows = [f"{100 * s:.5f};{p:.5f};{n:.5f}".replace(".", ",") for s, p, n in zip(curve.strain, load, poisson)]
    (folder / "grain.csv").write_text("\n".join(["Test 1;;", "Strain;Load;Poisson", "%;N;-", *rows]) + "\n", encoding="utf-8")


@pytest.fixture(scope="module")
def laboratory(tmp_path_factory):
    folder = tmp_path_factory.mktemp("laboratory")
    write_laboratory(folder)
    (folder / "grain.toml").write_text(STAGE + PARAMETERS + DATA, encoding="utf-8")
    return folder


def shell(folder, *words):
    return subprocess.Popen([sys.executable, "-m", "dem4grm", "calibrate", *words], cwd=folder, text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE)


def test_hidden_parameters_of_a_grain_are_found_after_a_kill(laboratory):
    """The calibration is killed in the middle of its trials and goes on from the shell; another one, without the kill and with other
    workers, gives the same."""
    first = shell(laboratory, "grain.toml", "-o", "killed", "-q")
    store = laboratory / "killed" / "1-rubber-grain" / "trials.jsonl"
    deadline = time.monotonic() + 120
    while not (store.exists() and len(store.read_bytes().splitlines()) >= 5) and first.poll() is None and time.monotonic() < deadline:
        time.sleep(0.02)
    first.send_signal(signal.SIGKILL)
    _, errors = first.communicate()
    assert first.returncode == -signal.SIGKILL, errors
    before = store.read_bytes()
    assert 5 <= before.count(b"\n") < 41
    store.write_bytes(before + b'{"kind": "trial", "point": 9')  # as if the kill had cut a line short

    again = shell(laboratory, "grain.toml", "-o", "killed", "-q")
    printed, errors = again.communicate(timeout=250)
    assert again.returncode == 0, errors
    assert re.search(r"walls.shear_modulus .* not identified", printed)
    assert store.read_bytes().startswith(before), "finished trials are kept as they are"
    records = [json.loads(line) for line in store.read_text(encoding="utf-8").splitlines()]
    assert len({(r["point"], r["number"]) for r in records}) == len(records) == 41, "no trial is run twice"
    assert all(len(r["state_hashes"]) == 1 for r in records)

    told = []
    found = dem4grm.calibrate(laboratory / "grain.toml", laboratory / "whole", workers=2, progress=lambda *now: told.append(now[2:]))
    assert len(told) == 41 and told[-1] == (41, 41)
    assert (laboratory / "whole/result.json").read_bytes() == (laboratory / "killed/result.json").read_bytes()
    lines = (laboratory / "whole/1-rubber-grain/trials.jsonl").read_bytes().splitlines(keepends=True)
    (laboratory / "late").mkdir()
    shutil.copytree(laboratory / "whole/1-rubber-grain", laboratory / "late/1-rubber-grain")
    (laboratory / "late/1-rubber-grain/trials.jsonl").write_bytes(b"".join(lines[:27]))  # killed in the second batch of proposals
    (laboratory / "late/1-rubber-grain/proposals.json").write_text(
        json.dumps(json.loads((laboratory / "whole/1-rubber-grain/proposals.json").read_text(encoding="utf-8"))[:2]), encoding="utf-8")
    dem4grm.calibrate(laboratory / "grain.toml", laboratory / "late", page=False)
    assert (laboratory / "late/result.json").read_bytes() == (laboratory / "whole/result.json").read_bytes()
    assert found.trials().equals(dem4grm.Calibration(laboratory / "killed").trials())
    check_recovery(found)
    check_page(found.path / "calibration.html")


def check_recovery(found):
    table = found.parameters
    for key, truth in TRUTH.items():
        row = table.loc[key]
        assert row.identified and row.at_bound == "", key
        assert abs(row.best / truth - 1.0) < 0.05, (key, row.best)
        assert row.interval_low < truth < row.interval_high, (key, row.interval_low, row.interval_high)
        assert (row.interval_high - row.interval_low) / truth < 0.3, key
    assert not table.loc["walls.shear_modulus"].identified
    assert set(found.best) == set(table.index) and found.best["rubber.bond.modulus"].endswith(" MPa")
    dem4grm.Case.read(CASES / "grain_compression.toml", found.best)
    stage = found.result["stages"][0]
    assert stage["misfit_per_value"] < 2.0 and stage["surrogate_error"] < 0.5 and stage["runs"] == 41
    assert abs(found.correlations().loc["rubber.bond.modulus", "rubber.bond.stiffness_ratio"]) > 0.3
    assert found.samples()["rubber.bond.modulus"].between(8.0, 60.0).all()


def check_page(path):
    text = path.read_text(encoding="utf-8")
    assert "not identified" in text and text.count("data:image/png;base64,") == 4
    assert not re.search(r"""(src|href)=["']?(?!["']?data:)|url\(|https?://""", text), "the page asks for nothing"


# ---- runs that something else starts ------------------------------------------------------------------------------------
LAUNCHER = ["/bin/sh", "-c", 'echo started >> started.txt; exec "$@"', "launcher"]
LOADS = [Series("load_N", "load_N", "strain", numpy.array([0.05, 0.1]), numpy.zeros(2), numpy.ones(2), numpy.zeros(2))]


def test_runs_behind_a_launcher_give_the_same(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    case = dem4grm.Case.read(CASES / "grain_compression.toml", COARSE)
    never = threading.Event()
    here = run_program(case, tmp_path / "here", LOADS, 1, never, True)
    there = run_program(case, tmp_path / "there", LOADS, 1, never, True, LAUNCHER)
    assert (here[0][0] == there[0][0]).all() and here[1] == there[1]
    assert (tmp_path / "started.txt").read_text() == "started\n"
    assert not (tmp_path / "there.toml").exists()


def test_a_launcher_hands_on_how_a_run_ended(tmp_path):
    case = dem4grm.Case(tiny.TEXT, "tiny.toml")
    stop = threading.Event()
    stop.set()
    with pytest.raises(dem4grm.Stopped):
        run_elsewhere(case, tmp_path / "stopped", ["/usr/bin/env"], 1, stop)
    assert run_elsewhere(case, tmp_path / "stopped", ["/usr/bin/env"], 1, threading.Event()).state_hash, "the same call goes on"
    with pytest.raises(dem4grm.IoError, match="/nowhere/srun: cannot be started"):
        run_elsewhere(case, tmp_path / "no", ["/nowhere/srun"], 1, threading.Event())
    for code, kind in ((76, dem4grm.PhysicsError), (74, dem4grm.IoError), (3, dem4grm.Error)):
        with pytest.raises(kind, match="no room on this node"):
            run_elsewhere(case, tmp_path / "failed", ["/bin/sh", "-c", f"echo no room on this node >&2; exit {code}"], 1, threading.Event())


# ---- a model of one's own: the statistics, without the cost -----------------------------------------------------------
def closed_form(case, seed, series):
    """Load over strain with the part of the bonds and that of Hertz contacts; a seed moves both, as a specimen would. Poisson's ratio of
    the walls does nothing."""
    bond, ball = case.si("rubber.bond.modulus") / 20e6, case.si("rubber.shear_modulus") / 12e6
    random = numpy.random.default_rng(seed + 977)
    shift = 0.0 if NOISE == 0.0 else NOISE * random.standard_normal()
    return [(10.0 * bond * s.x + 60.0 * ball * s.x**1.5) * (1.0 + shift) for s in series]


NOISE = 0.0
TWO = """[[stage.parameter]]
key = "rubber.bond.modulus"
low = "5 MPa"
high = "80 MPa"
scale = "log"
[[stage.parameter]]
key = "rubber.shear_modulus"
low = "3 MPa"
high = "48 MPa"
scale = "log"
"""


def closed_form_desk(folder, repeat, noise, replicates=0, specimens=1):
    """Data of hidden values: the closed form with errors of measurement, and with the noise of specimens of their own, the mean of which they are."""
    random = numpy.random.default_rng(repeat)
    truth = {"rubber.bond.modulus": float(random.uniform(12, 40)), "rubber.shear_modulus": float(random.uniform(6, 24))}
    x = numpy.linspace(0.02, 0.2, 10)
    curve = 10.0 * truth["rubber.bond.modulus"] / 20 * x + 60.0 * truth["rubber.shear_modulus"] / 12 * x**1.5
    y = curve * (1.0 + noise * random.standard_normal(specimens).mean()) + 0.05 * random.standard_normal(10)
    text = (STAGE.replace("seed = 5", f"seed = {repeat}").replace("trials = 32\nstart = 20", f"trials = 16\nreplicates = {replicates}\nspecimens = {specimens}")
            + TWO + f"[[stage.data]]\nquantity = \"load_N\"\nx = \"strain\"\nerror = 0.05\nvalues = {numpy.array([x, y]).T.tolist()}\n")
    return dem4grm.Desk.parse(text, folder / f"repeat{repeat}.toml"), truth


@pytest.mark.parametrize("noise, specimens, widest", [(0.0, 1, 0.25), (0.03, 1, 0.4), (0.03, 16, 0.25)])
def test_intervals_cover_the_truth(tmp_path, monkeypatch, noise, specimens, widest):
    """Ten repeats with other truths and other noise: the 95 % intervals of both parameters hold the truth in at least eight, and are the
    narrower the more specimens the data are the mean of."""
    monkeypatch.setattr(sys.modules[__name__], "NOISE", noise)
    covered = {"rubber.bond.modulus": 0, "rubber.shear_modulus": 0}
    widths = []
    for repeat in range(10):
        desk, truth = closed_form_desk(tmp_path, repeat, noise, 6 if noise else 0, specimens)
        found = dem4grm.calibrate(desk, tmp_path / str(repeat), simulator=closed_form, page=False).parameters
        for key, value in truth.items():
            covered[key] += int(found.interval_low[key] < value < found.interval_high[key])
        widths.append(float(numpy.log(found.interval_high / found.interval_low).mean()))
    assert min(covered.values()) >= 8, covered
    assert numpy.median(widths) < widest, "intervals that cover by being wide say nothing"


def test_stop_and_failures(tmp_path):
    desk, _ = closed_form_desk(tmp_path, 3, 0.0)

    def picky(case, seed, series):
        if case.si("rubber.bond.modulus") > 60e6:
            raise dem4grm.PhysicsError("too stiff for this model")
        return closed_form(case, seed, series)

    with pytest.raises(dem4grm.Stopped):
        dem4grm.calibrate(desk, tmp_path / "run", simulator=picky, progress=lambda stage, record, done, total: done < 6)
    with pytest.raises(dem4grm.MissingFileError, match="no finished calibration"):
        dem4grm.Calibration(tmp_path / "run")
    found = dem4grm.calibrate(desk, tmp_path / "run", simulator=picky, page=False)
    trials = found.trials()
    assert trials.failure.notna().sum() == found.result["stages"][0]["failed_trials"] >= 1
    assert found.parameters.identified.all()
    other, _ = closed_form_desk(tmp_path, 4, 0.0)
    with pytest.raises(dem4grm.UsageError, match="another desk"):
        dem4grm.calibrate(other, tmp_path / "run", simulator=picky, page=False)

    def never(case, seed, series):
        raise dem4grm.PhysicsError("this model never works")

    with pytest.raises(dem4grm.MissedError, match="this model never works"):
        dem4grm.calibrate(desk, tmp_path / "never", simulator=never, page=False)


def test_stages_hand_on_what_they_found_and_mixtures_are_predicted(tmp_path):
    """Two stages and a prediction; what the first has found is held in the second, and the mixture is run with both."""
    asked = []

    def model(case, seed, series):
        asked.append((case.test, case.si("rubber.bond.modulus"), case.si("gravel.friction") if case.test == "direct_shear" else None))
        if case.test == "grain_compression":
            return [100.0 * case.si("rubber.bond.modulus") / 20e6 * s.x for s in series]
        return [numpy.full(max(1, len(s.x)), 50.0 * case.si("gravel.friction")) for s in series]

    text = STAGE.replace("trials = 32\nstart = 20", "trials = 8") + TWO.split("[[stage.parameter]]\nkey = \"rubber.shear")[0] + f"""
[[stage.data]]
quantity = "load_N"
x = "strain"
error = "1 %"
values = [[0.1, 12.0], [0.2, 24.0]]
[[stage]]
name = "gravel"
case = "{CASES}/quick.toml"
trials = 8
set = {{ "specimen.rubber_content" = 0.0 }}
full = {{ "shear.velocity" = "2 mm/s" }}
[[stage.parameter]]
key = "gravel.friction"
low = 0.2
high = 1.2
[[stage.data]]
quantity = "peak_shear_stress_kPa"
value = 35.0
error = 1.0
set = {{ "shear.normal_stress" = "60 kPa" }}
[[predict]]
name = "mixture"
case = "{CASES}/quick.toml"
[[predict.data]]
quantity = "peak_shear_stress_kPa"
value = 40.0
error = 2.0
"""
    desk = dem4grm.Desk.parse(text, tmp_path / "two.toml")
    assert desk.stages[1].given == {"rubber.bond.modulus": "rubber grain"}
    found = dem4grm.calibrate(desk, tmp_path / "run", simulator=model)
    assert abs(found.parameters.best["rubber.bond.modulus"] - 24.0) < 0.5 and abs(found.parameters.best["gravel.friction"] - 0.7) < 0.03
    modulus = float(found.best["rubber.bond.modulus"].split()[0]) * 1e6
    assert all(abs(row[1] / modulus - 1) < 1e-12 for row in asked if row[0] == "direct_shear")
    (prediction,) = found.result["predictions"]
    assert abs(prediction["data"][0]["predicted"][0] - 35.0) < 1.0
    roles = found.trials("gravel").role.value_counts()
    assert roles["replicate"] == 4 and roles["full"] == roles["best"] == 1


# ---- the desk file -----------------------------------------------------------------------------------------------------
def problems_of(text, folder):
    with pytest.raises(dem4grm.CaseError) as caught:
        dem4grm.Desk.parse(text, folder / "desk.toml")
    return caught.value.problems


def test_mixtures_are_refused_in_a_fit(tmp_path):
    text = f"""[[stage]]
case = "{CASES}/quick.toml"
[[stage.parameter]]
key = "gravel.friction"
low = 0.2
high = 1.2
[[stage.data]]
quantity = "peak_shear_stress_kPa"
value = 35.0
error = 1.0
"""
    (problem,) = problems_of(text, tmp_path)
    assert "desk.toml:2:8" in problem and "specimen.rubber_content = 0.25" in problem and "allow_mixtures = true" in problem
    allowed = dem4grm.Desk.parse(text.replace("[[stage]]\n", "[[stage]]\nallow_mixtures = true\n"), tmp_path / "desk.toml")
    assert len(allowed.stages) == 1
    for content in ("0.0", "1.0"):
        assert dem4grm.Desk.parse(text.replace("error = 1.0", f"error = 1.0\nset = {{ \"specimen.rubber_content\" = {content} }}"), "d.toml")


def test_every_problem_of_a_desk_is_reported_at_once(laboratory):
    text = (STAGE + PARAMETERS + DATA).replace("trials = 32", "trails = 32").replace("\"8 MPa\"", "\"1 kPa\"", 1).replace(
        "1.5\nhigh = 9.0", "9.0\nhigh = 1.5").replace("walls.shear_modulus", "walls.shear_modulo").replace(
        "quantity = \"load_N\"", "quantity = \"load_kN\"").replace("y_column = \"Poisson\"", "y_column = \"nu\"")
    problems = problems_of(text, laboratory)
    lines = text.splitlines()
    for wanted, line in (("unknown key \"trails\" in [[stage]]; did you mean \"trials\"?", "trails = 32"),
                         ("rubber.bond.modulus = \"1 kPa\" is outside [10 kPa, 1000 GPa]", "low = \"1 kPa\""),
                         ("low = 9.0 has to be below high = 1.5", "low = 9.0"),
                         ("shear_modulo", "key = \"walls.shear_modulo\""),
                         ("quantity = \"load_kN\" is no column of a grain_compression test; allowed are", "quantity = \"load_kN\""),
                         ("no line with the columns \"Strain\" and \"nu\"", "file = \"grain.csv\"")):
        mine = [p for p in problems if wanted in p]
        assert mine, (wanted, problems)
        assert int(mine[0].split(":")[1]) in [k for k, text_line in enumerate(lines, 1) if text_line == line], mine[0]
    done = shell(laboratory, "missing.toml")
    done.communicate()
    (laboratory / "bad.toml").write_text(text, encoding="utf-8")
    bad = shell(laboratory, "bad.toml")
    _, errors = bad.communicate()
    usage = shell(laboratory, "grain.toml", "--workers", "none")
    usage.communicate()
    assert (done.returncode, bad.returncode, usage.returncode) == (66, 65, 64)
    assert f"{len(problems)} errors, nothing was run" in errors and os.listdir(laboratory).count("runs") == 0


def test_files_of_laboratories(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("Machine 7\nd [mm],F [kN]\nmm,kN\n0.0,0.1\n,\n1.0,0.3\n", encoding="utf-8")
    found = read_curve(path, "d [mm]", "F [kN]")
    assert found.x.tolist() == [0.0, 1.0] and found.y.tolist() == [0.1, 0.3]
    path.write_text("d\tF\n0,5\t1,5\n1,0\tx\n", encoding="utf-8")
    assert "line 3" in read_curve(path, "d", "F").problem
    x, y = thinned(numpy.arange(100.0), numpy.arange(100.0), 10)
    assert len(x) == 10 and numpy.allclose(x, y) and numpy.allclose(numpy.diff(x), 9.9, atol=0.2)
    assert numpy.allclose(errors_of(["3 %", 4.0], numpy.array([0.0, 100.0])), [4.0, 5.0])
    assert errors_of("much", numpy.ones(1)) is None and errors_of(-1, numpy.ones(1)) is None


def test_quantities_are_those_of_finished_tests(finished, laboratory):
    assert set(CURVES["direct_shear"]) <= set(finished.shear.columns) and set(NUMBERS["direct_shear"]) <= set(finished.summary)
    asked = [Series("tau", "shear_stress_kPa", "displacement_mm", numpy.array([0.0, 0.5]), *numpy.ones((3, 2))),
             Series("e", "void_ratio_before_shear", "", numpy.empty(0), *numpy.ones((3, 1)))]
    curves, state_hash = run_program(tiny.case(), finished.path, asked, 1, StopOf(), keep=True)
    near = finished.shear.iloc[(finished.shear.displacement_mm - 0.5).abs().argmin()].shear_stress_kPa
    assert abs(curves[0][1] / near - 1.0) < 0.05 and state_hash == finished.state_hash
    assert curves[1].tolist() == [finished.summary["void_ratio_before_shear"]]
    grain = dem4grm.open(laboratory / "hidden")
    assert set(CURVES["grain_compression"]) <= set(grain.compression.columns)
    assert set(NUMBERS["grain_compression"]) <= set(grain.summary)


def test_shipped_desks_are_right_and_fit_no_mixture():
    for path in sorted((CASES / "calibration").glob("*.toml")):
        desk = dem4grm.Desk.read(path)
        assert desk.stages and desk.stages[0].name == "rubber grain", path
    article = dem4grm.Desk.read(CASES / "calibration/article.toml")
    assert [s.name for s in article.stages] == ["rubber grain", "gravel", "rubber"] and len(article.predictions) == 4
    assert set(article.stages[1].given) == {"rubber.bond.modulus", "rubber.shear_modulus", "rubber.bond.stiffness_ratio"}
    given = article.stages[2].given
    assert set(given) >= {"gravel.friction", "rubber.shear_modulus"} and "rubber.bond.modulus" not in given
