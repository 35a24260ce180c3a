# SPDX-License-Identifier: BSD-3-Clause
"""Simulation: bits, checkpoints, views, motions, plates, and what goes wrong. Physics against closed forms: test_examples.py and
tests/physics."""
import gc
import os
import signal
import subprocess
import sys
import threading

import dem4grm
import numpy
import pytest


def box_of_grains(threads=1, **options):
    """64 clumps and 16 rubber grains that fall and are pressed: every kernel has something to do."""
    sim = dem4grm.Simulation(gravity=(0.0, 0.0, -9.81), local_damping=0.2, threads=threads, **options)
    sim.rubber_ball_radius = 0.5e-3
    random = numpy.random.default_rng(4)
    for number, place in enumerate(numpy.ndindex(4, 4, 5)):
        at, turn = (numpy.array(place) + 0.5) * 4.4e-3, random.normal(size=4)
        if number % 5 == 2:
            sim.add_rubber_grain(at, orientation=turn, velocity=(0, 0, -0.5))
        else:
            sim.add_clump(f"T{1 + number % 6}", at, 3.9e-3, orientation=turn)
    walls = sim.add_box((17.6e-3, 17.6e-3, 22e-3), friction=0.4)
    walls["+z"].carry(stress=50e3, between=[walls[name] for name in ("-x", "+x", "-y", "+y")], speed_cap=0.5)
    walls["+x"].move([0.0, 1e-3, 2e-3], [(0, 0, 0), (-0.1, 0, 0), (0, 0, 0)])
    sim.choose_time_step(stress=50e3)
    return sim


def test_any_number_of_threads_gives_the_same_bits():
    hashes = []
    for threads in (1, 2, 3):
        sim = box_of_grains(threads)
        sim.run(400)
        hashes.append(sim.state_hash)
    assert len(set(hashes)) == 1
    assert len(sim.contacts["normal_force"]) > 20 and sim.walls["+z"].n_contacts > 0
    again = box_of_grains()
    for _ in range(40):  # neither do pieces
        again.run(10)
    assert again.state_hash == hashes[0]


def test_a_saved_test_goes_on_with_the_same_bits(tmp_path):
    sim = box_of_grains()
    sim.run(150)
    sim.save(tmp_path / "state.h5")
    sim.run(250)
    other = dem4grm.Simulation.load(tmp_path / "state.h5", threads=2)
    assert other.steps == 150 and set(other.walls) == set(sim.walls)
    other.run(250)
    assert other.state_hash == sim.state_hash
    assert other.walls["+z"].normal_force == sim.walls["+z"].normal_force
    data = bytearray((tmp_path / "state.h5").read_bytes())
    data[len(data) // 2] ^= 1
    (tmp_path / "state.h5").write_bytes(data)
    with pytest.raises(dem4grm.IoError):
        dem4grm.Simulation.load(tmp_path / "state.h5")


def test_views_are_live_cannot_be_written_and_outlive_the_object():
    sim = box_of_grains()
    positions, pebbles = sim.positions, sim.pebbles
    assert positions.shape == (64, 3) and not positions.flags.owndata and not positions.flags.writeable
    with pytest.raises(ValueError):
        positions[0, 0] = 1.0
    with pytest.raises(ValueError):
        pebbles["radius"][0] = 1.0
    before = positions.copy()
    sim.run(50)
    after = positions.copy()
    assert numpy.array_equal(positions, sim.positions) and not numpy.array_equal(positions, before)
    # A pebble turns with its clump: never farther away than the clump is large.
    arm = numpy.linalg.norm(pebbles["position"] - positions[pebbles["clump"]], axis=1) + pebbles["radius"]
    assert arm.max() < 3.9e-3 and sim.rubber_balls.shape == (16, 35, 3)
    del sim
    gc.collect()
    assert numpy.array_equal(positions, after)  # the memory is still there


def test_walls_move_as_prescribed():
    sim = dem4grm.Simulation()
    sim.add_ball((0, 0, 0), 1e-3)
    wall = sim.add_wall("far", (1, 1, 1), (0, 1, 0), (0, 0, 1))
    wall.move([0.0, 1e-3, 3e-3], [(0, 0, 0), (0.2, 0, 0), (0.2, 0, 0.1)])
    sim.time_step = 1e-5
    sim.run(time=3e-3)
    assert sim.steps == 300 and sim.time == pytest.approx(3e-3)
    # Area under the table.
    assert wall.position - (1, 1, 1) == pytest.approx([0.1e-3 + 0.4e-3, 0, 0.1e-3], rel=1e-9)
    wall.velocity = (0, 0, 1.0)
    sim.run(100)
    assert wall.position[2] == pytest.approx(1 + 0.1e-3 + 1e-3)


def test_a_plate_carries_its_force_and_friction_can_be_set():
    sim = dem4grm.Simulation(local_damping=0.5)
    sim.add_ball((0, 0, 1e-3), 1e-3)
    sim.add_wall("floor", (-1, -1, 0), (2, 0, 0), (0, 2, 0), friction=0.5)
    sim.add_wall("stop", (1e-3, -1, -1), (0, 0, 3), (0, 2, 0))
    lid = sim.add_wall("lid", (-1, -1, 2.1e-3), (0, 2, 0), (2, 0, 0))
    lid.carry(2.0, speed_cap=0.5)
    sim.choose_time_step(1e6)
    assert sim.run_until(lambda: abs(lid.normal_force - 2.0) < 1e-9, every=100)
    assert lid.stiffness > 0 and lid.n_contacts == 1
    sim.set_friction(gravel_wall=0.1)
    # The floor drags the ball against the stop and turns it there, so it slips on the lid, at the smaller one of both limits.
    sim.walls["floor"].move([0.0], [(0.05, 0, 0)])
    lid.friction = 0.05
    sim.run(4000)
    limit = sim.wall_contacts
    share = numpy.linalg.norm(limit["shear_force"], axis=1) / limit["normal_force"]
    assert share.max() <= 0.1 + 1e-12 and share[limit["wall"] == lid.number] == pytest.approx(0.05)
    assert sim.energy["slip"] > 0 and abs(sim.energy_error) < 0.02 * sim.energy["boundary_work"]


def test_energy_closes_when_grains_start_at_rest():
    sim = box_of_grains()
    sim.run(1)
    start = sim.energy
    sim.run(2000)
    change = {name: value - start[name] for name, value in sim.energy.items()}
    left = sum(value for name, value in change.items() if name != "boundary_work") - change["boundary_work"]
    print("open", left, "J of", change)
    assert change["slip"] > 0
    assert abs(left) < 0.01 * (change["slip"] + change["local_damping"])


def test_errors_say_what_is_wrong():
    sim = dem4grm.Simulation()
    with pytest.raises(dem4grm.CaseError, match="at least one grain"):
        sim.run(1)
    ball = sim.add_ball((0, 0, 0), 1e-3)
    with pytest.raises(ValueError, match="gravel"):
        sim.add_ball((0, 0, 0), 1e-3, material="steel")
    with pytest.raises(ValueError, match="no clump shape"):
        sim.add_clump("T9", (0, 0, 0), 1e-3)
    with pytest.raises(ValueError, match="square to each other"):
        sim.add_wall("w", (0, 0, 0), (1, 0, 0), (1, 1, 0))
    with pytest.raises(dem4grm.CaseError, match="hang together"):
        sim.add_shape("two", [[0, 0, 0, 1], [5, 0, 0, 1]])
    sim.add_shape("peanut", [[0, 0, 0, 1], [1.2, 0, 0, 1]])
    sim.add_clump("peanut", (1, 0, 0), 2e-3)
    wall = sim.add_wall("w", (0, 0, -1), (1, 0, 0), (0, 1, 0))
    with pytest.raises(dem4grm.UsageError, match="already"):
        sim.add_wall("w", (0, 0, 0), (1, 0, 0), (0, 1, 0))
    with pytest.raises(ValueError, match="either a force or a stress"):
        wall.carry()
    with pytest.raises(ValueError, match="ascend"):
        wall.move([1.0, 0.0], [(0, 0, 0), (0, 0, 0)])
    with pytest.raises(dem4grm.CaseError, match="no time step"):
        sim.run(1)
    with pytest.raises(dem4grm.UsageError, match="has begun"):
        sim.add_ball((0, 0, 0), 1e-3)
    with pytest.raises(dem4grm.CaseError, match="positive"):
        sim.time_step = -1.0
    assert ball.position == pytest.approx([0, 0, 0])


def test_the_watchdog_looks_at_own_tests_too():
    sim = dem4grm.Simulation()
    sim.add_ball((0, 0, 0), 1e-3)
    sim.add_ball((0.1e-3, 0, 0), 1e-3)  # caught inside each other
    sim.time_step = 1e-9
    with pytest.raises(dem4grm.PhysicsError, match="overlap"):
        sim.run(1000)


def test_one_simulation_in_two_threads_is_refused_and_two_are_not():
    sim, other = box_of_grains(), box_of_grains()
    begun = threading.Event()

    def work():
        begun.set()
        sim.run(4000)

    thread = threading.Thread(target=work)
    thread.start()
    begun.wait()
    refused = 0
    while thread.is_alive():
        try:
            sim.state_hash
        except dem4grm.UsageError:
            refused += 1
            if refused == 1:
                other.run(400)
                child = os.fork()  # while the other thread steps
                if child == 0:
                    try:
                        sim.run(1)
                    except dem4grm.UsageError:
                        os._exit(5)
                    os._exit(6)
                assert os.waitpid(child, 0)[1] >> 8 == 5
    thread.join()
    assert refused > 0 and sim.steps == 4000 and other.steps == 400
    single = box_of_grains()
    single.run(400)
    assert other.state_hash == single.state_hash


def test_a_fork_after_threads_steps_on(tmp_path):
    sim = box_of_grains(threads=2)
    sim.run(100)
    child = os.fork()
    if child == 0:
        sim.run(100)
        (tmp_path / "hash").write_text(sim.state_hash)
        os._exit(0)
    assert os.waitpid(child, 0)[1] == 0
    sim.run(100)
    assert sim.state_hash == (tmp_path / "hash").read_text()


def test_ctrl_c_ends_after_a_whole_step():
    for threads in (1, 2):
        sim = box_of_grains(threads)
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with pytest.raises(KeyboardInterrupt):
            sim.run(50_000_000)
        steps = sim.steps
        assert 0 < steps < 50_000_000
        other = box_of_grains()
        if threads == 1:  # one comparison is enough
            other.run(steps)
            assert other.state_hash == sim.state_hash


def test_nothing_is_loaded_by_an_import_that_a_user_did_not_ask_for():
    code = "import sys, dem4grm; print('matplotlib' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.strip() == "False"
