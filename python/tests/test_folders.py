# SPDX-License-Identifier: BSD-3-Clause
"""Finished folders: tables with units, states on demand, micro-mechanics, sieve analysis; and networks given as arrays."""
import json
import math
import shutil
import subprocess

import dem4grm
import numpy
import pytest


def test_tables_have_units(finished):
    shear = finished.shear
    assert len(shear) == 100 and shear.attrs["units"]["shear_stress_kPa"] == "kPa"
    assert finished.micro.attrs["units"]["theta_a_all_deg"] == "deg"
    assert "upper border" in finished.profiles.attrs["descriptions"]["high_mm"]
    assert len(finished.walls) == len(shear)
    assert shear["shear_stress_kPa"].max() == pytest.approx(finished.summary["peak_shear_stress_kPa"], rel=0.2)
    with pytest.raises(dem4grm.MissingFileError, match="direct_shear"):
        finished.compression
    assert finished.case.name == "tiny" and "complete" in repr(finished)


def test_states_are_found_by_displacement_and_read_on_demand(finished):
    states = finished.states
    assert [round(at, 1) for at in states] == [0.0, 0.2, 0.5, 1.0]
    state = states[0.5]
    assert state is states[0.46] and state.displacement == pytest.approx(0.5e-3, rel=0.01)
    with pytest.raises(KeyError, match="no state at 0.7 mm; there are 0.000"):
        states[0.7]
    contacts = state.contacts
    assert contacts.normal_force is not contacts.normal_force  # nothing is kept
    assert contacts.normal.shape == (len(contacts["normal_force"]), 3) and contacts.units["normal_force"] == "N"
    with pytest.raises(AttributeError, match="there are"):
        contacts.forces
    frame = contacts.frame()
    assert {"normal_x", "normal_y", "normal_z"} <= set(frame) and frame.attrs["units"]["point_x"] == "m"
    assert len(state.clumps.frame()) == 137 and state.clumps["shape_names"][0].startswith("T")
    assert state.balls.position.shape == (137 * 0 + len(state.balls.radius), 3)
    assert states.last.state_hash == finished.state_hash


def test_a_damaged_file_of_states_is_refused(finished, tmp_path):
    shutil.copytree(finished.path, tmp_path / "damaged")
    file = tmp_path / "damaged/results.h5"
    content = bytearray(file.read_bytes())
    content[len(content) // 2] ^= 1
    file.write_bytes(content)
    with pytest.raises(dem4grm.IoError, match="does not fit its seal"):
        dem4grm.Test(tmp_path / "damaged").states


def test_a_state_in_balance(finished):
    """Forces of the contacts of a grain nearly cancel at the start of shear: the arrays belong together, signs included."""
    contacts = finished.states.first.contacts
    force = contacts.shear_force - contacts.normal * contacts.normal_force[:, None]
    net = numpy.zeros((int(max(contacts.body_i.max(), contacts.body_j.max())) + 1, 3))
    numpy.add.at(net, contacts.body_i, force)
    between = contacts.body_j >= 0
    numpy.subtract.at(net, contacts.body_j[between], force[between])
    largest = numpy.linalg.norm(net, axis=1).max()
    print("largest net force", largest, "N; mean contact force", contacts.normal_force.mean(), "N")
    assert numpy.linalg.norm(net, axis=1).mean() < 0.1 * contacts.normal_force.mean()


def test_micro_mechanics_are_those_of_the_command_line(finished):
    found = finished.states[1.0].micro(bins=72, resamples=20)
    answer = subprocess.run([dem4grm.program(), "micro", finished.path, "--at", "1mm", "--bin-width", "5", "--bootstrap", "20",
                             "--json"], capture_output=True, text=True, check=True)
    other = json.loads(answer.stdout)
    assert found.numbers["coordination"] == other["coordination"]
    assert found.sets.loc["g-r", "a_n"] == other["sets"]["g-r"]["a_n"]
    assert found.bands["all"] == other["sets"]["all"]["bands_95"]
    assert numpy.trace(found.fabric_tensor) == pytest.approx(1.0)
    assert len(found.histograms) == 72 * 4
    assert finished.micro["a_n_all"].iloc[-1] == finished.states[1.0].micro().sets.loc["all", "a_n"]


def test_a_network_given_as_arrays_has_the_numbers_of_the_state(finished):
    state = finished.states[1.0]
    contacts = state.contacts
    grains = contacts.body_j >= 0
    # The numbers of bodies and kinds as the arrays tell them: rubber grains come first.
    n_rubber, n_clumps = len(state.rubber_grains["centre"]), len(state.clumps["mass"])
    bodies = numpy.column_stack([contacts.body_i, contacts.body_j])[grains]
    kinds = (bodies < n_rubber).sum(axis=1)
    found = dem4grm.micro.analyse(
        contacts.normal[grains], contacts.normal_force[grains], contacts.shear_force[grains], kinds=kinds, bodies=bodies,
        n_bodies=n_rubber + n_clumps, sliding=contacts.is_sliding[grains])
    expected = state.micro()
    for name in ("a", "theta_a_deg", "a_n", "a_t", "theta_n_deg", "normal_force_N", "bulk_friction", "sliding"):
        assert numpy.array_equal(found.sets[name], expected.sets[name], equal_nan=True), name
    assert found.numbers["coordination"] == expected.numbers["coordination"]
    assert math.isnan(found.numbers["stress_zz_kPa"]) and math.isnan(found.numbers["bond_strain"])


def test_a_network_worked_by_hand():
    """Contacts along x and z alone, half of each, the forces along z three times as large: E(theta) has its mean everywhere but in
    two directions; the tensor is diag(1/2, 0, 1/2), and stress follows from force times branch over volume."""
    normals = numpy.array([[1.0, 0, 0], [0, 0, 1.0]] * 10)
    forces = numpy.where(normals[:, 2] > 0, 3.0, 1.0)
    found = dem4grm.micro.analyse(normals, forces, branches=normals * 2e-3, volume=1e-6)
    assert numpy.allclose(found.fabric_tensor, numpy.diag([0.5, 0, 0.5]))
    assert found.numbers["stress_xx_kPa"] == pytest.approx(10 * 1.0 * 2e-3 / 1e-6 / 1e3)
    assert found.numbers["stress_zz_kPa"] == pytest.approx(10 * 3.0 * 2e-3 / 1e-6 / 1e3)
    assert numpy.allclose(dem4grm.micro.stress_tensor(normals * forces[:, None], normals * 2e-3, 1e-6),
                          numpy.diag([2e4, 0, 6e4]))
    assert numpy.allclose(dem4grm.micro.fabric_tensor(normals), found.fabric_tensor)
    with pytest.raises(ValueError, match="unit vectors"):
        dem4grm.micro.analyse(normals * 2, forces)
    with pytest.raises(ValueError, match=r"normal_force must have the shape \[20\]"):
        dem4grm.micro.analyse(normals, forces[:3])
    with pytest.raises(ValueError, match="level must be"):
        dem4grm.micro.analyse(normals, forces, bodies=numpy.zeros((20, 2)), level="contcat")
    with pytest.raises(ValueError, match=r"\[n, 3\]"):
        dem4grm.micro.fabric_tensor(normals[:, :2])


def test_sieve_analysis(finished):
    table = finished.sieve([3.6, 3.8, 4.0])
    assert list(table["sieve_mm"]) == [3.6, 3.8, 4.0]
    assert table["gravel_passing_percent"].iloc[-1] == pytest.approx(100.0)
    assert table.attrs["figures"]


def test_verification():
    checks = dem4grm.verify("hertz-impact-spheres", threads=1)
    assert len(checks) > 3 and checks.attrs["missed"] == 0 and checks["passed"].all()
    assert "hertz-impact-spheres" in set(dem4grm.verification_cases()["name"])
    with pytest.raises(dem4grm.UsageError, match="hertz-impact-sphere"):
        dem4grm.verify("hertz-impact-sphere")


def test_a_report_is_made_or_says_why_not(finished, tmp_path):
    (tmp_path / "lab.csv").write_text("displacement_mm,shear_stress_kPa\n0,0\n0.5,40\n")
    (tmp_path / "wrong.csv").write_text("time,force\n0,0\n")
    with pytest.raises(dem4grm.CaseError, match="no line names the columns"):
        finished.report(tmp_path / "page.html", laboratory=[tmp_path / "wrong.csv"])
    try:
        page = finished.report(tmp_path / "page.html", laboratory=[tmp_path / "lab.csv"])
    except dem4grm.MissingFileError as missing:
        assert "carries no page" in str(missing)  # built where there was no node
        return
    assert page == tmp_path / "page.html" and page.read_text(encoding="utf-8").endswith("</html>\n")
