# SPDX-License-Identifier: BSD-3-Clause
"""Runs: the bits of the command line, and every way to stop one. Not tested: that a full disk is said (tests/lab)."""
import json
import os
import signal
import threading
import time

import dem4grm
import pytest
import tiny


@pytest.fixture(scope="module")
def bits(tmp_path_factory):
    """The state hash of the tiny case by the command line."""
    folder = tmp_path_factory.mktemp("command")
    tiny.case().write(folder / "tiny.toml")
    tiny.command("run", "tiny.toml", "-o", "run", "-q", "-j", "1", folder=folder)
    return json.loads((folder / "run" / "summary.json").read_text())["state_hash"]


def test_same_bits_as_the_command_line(finished, bits):
    assert finished.state_hash == bits and finished.was_complete is False
    again = tiny.run(finished.case, finished.path)
    assert again.was_complete is True and again.state_hash == bits


def test_two_threads_and_progress_change_no_bit(tmp_path, bits):
    told = []
    test = dem4grm.run(tiny.case(), tmp_path / "run", threads=2, message=None, interval=0, progress=told.append)
    assert test.state_hash == bits
    stages = list(dict.fromkeys(now.stage for now in told))
    assert stages[0] == "fill" and stages[-1] == "shear"
    assert len(told) > 100 and told[-1].fraction == pytest.approx(1.0, abs=0.01)
    assert told[-1].displacement == pytest.approx(1e-3, rel=0.01) and told[-1].normal_stress == pytest.approx(100e3, rel=0.1)


def finish_by_command(folder, bits):
    """What a stopped run left is finished by the command line, with the bits of a run that was never stopped."""
    assert (folder / "run" / "checkpoint.h5").exists() and not (folder / "run" / "run.lock").exists()
    assert json.loads((folder / "run" / "status.json").read_text())["state"] == "stopped"
    tiny.case().write(folder / "tiny.toml")
    tiny.command("run", "tiny.toml", "-o", "run", "-q", "-j", "1", folder=folder)
    assert "goes on from the checkpoint" in dem4grm.open(folder / "run").log
    assert dem4grm.open(folder / "run").state_hash == bits


def test_a_callback_that_says_false_stops(tmp_path, bits):
    with pytest.raises(dem4grm.Stopped) as caught:
        tiny.run(tiny.case(), tmp_path / "run", interval=0, progress=lambda now: now.displacement < 0.3e-3)
    assert caught.value.exit_code == 75
    finish_by_command(tmp_path, bits)


def test_an_exception_of_a_callback_stops_and_comes_back(tmp_path, bits):
    class Mine(Exception):
        pass

    def fail(now):
        if now.stage == "compression":
            raise Mine("from inside")

    with pytest.raises(Mine, match="from inside"):
        tiny.run(tiny.case(), tmp_path / "run", interval=0, progress=fail)
    finish_by_command(tmp_path, bits)


def test_another_thread_stops_and_python_goes_on_meanwhile(tmp_path, bits):
    stop, begun, ticks = threading.Event(), threading.Event(), []

    def tick_and_stop():
        begun.wait(60)
        for _ in range(50):  # would stand still if the run held the lock of the interpreter
            ticks.append(time.monotonic())
            time.sleep(0.001)
        stop.set()

    thread = threading.Thread(target=tick_and_stop)
    thread.start()
    with pytest.raises(dem4grm.Stopped):
        tiny.run(tiny.case(shear__displacement="10 mm"), tmp_path / "run", interval=0, stop=stop,
                 progress=lambda now: begun.set())
    thread.join()
    assert len(ticks) == 50 and ticks[-1] - ticks[0] < 2.0
    assert (tmp_path / "run" / "checkpoint.h5").exists()


def test_ctrl_c_stops_with_a_checkpoint(tmp_path, bits):
    def interrupt(now):
        if now.stage == "shear" and now.displacement > 0.2e-3 and not sent:
            sent.append(now)
            os.kill(os.getpid(), signal.SIGINT)

    sent = []
    with pytest.raises(KeyboardInterrupt):
        tiny.run(tiny.case(), tmp_path / "run", interval=0, progress=interrupt)
    finish_by_command(tmp_path, bits)


def test_python_goes_on_with_what_it_stopped(tmp_path, bits):
    with pytest.raises(dem4grm.Stopped):
        tiny.run(tiny.case(), tmp_path / "run", max_hours=1e-9)
    assert tiny.run(tiny.case(), tmp_path / "run").state_hash == bits


def test_errors_have_classes_and_messages(finished, tmp_path):
    with pytest.raises(dem4grm.UsageError, match="another case"):
        tiny.run(tiny.case(seed=4), finished.path)
    with pytest.raises(dem4grm.MissingFileError, match="no such file"):
        tiny.run(tiny.case(), tmp_path / "run", specimen=tmp_path / "none")
    with pytest.raises(dem4grm.IoError):
        tiny.run(tiny.case(), "/proc/none")

    seen = []

    def twice(now):
        if not seen:
            seen.append(now)
            with pytest.raises(dem4grm.FolderInUseError, match=f"process {os.getpid()}"):
                tiny.run(tiny.case(), tmp_path / "run")
            return False
        return None

    with pytest.raises(dem4grm.Stopped):
        tiny.run(tiny.case(), tmp_path / "run", progress=twice)


def test_two_runs_in_two_threads(tmp_path, bits):
    hashes = {}

    def one(name):
        hashes[name] = dem4grm.run(tiny.case(), tmp_path / name, threads=2, message=None, interval=0,
                                   progress=lambda now: None).state_hash

    threads = [threading.Thread(target=one, args=(name,)) for name in ("a", "b")]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert hashes == {"a": bits, "b": bits}


def test_forks_do_no_harm(tmp_path, bits):
    """A child that runs a test of its own in several threads, one that is forked in a callback and returns into the run, and one
    that ends there."""
    dem4grm.run(tiny.case(), tmp_path / "before", threads=2, message=None)  # OpenMP has threads that the child does not get
    child = os.fork()
    if child == 0:
        test = dem4grm.run(tiny.case(), tmp_path / "child", threads=2, message=None)
        os._exit(0 if test.state_hash == bits else 1)
    assert os.waitpid(child, 0)[1] == 0

    children = []

    def fork(now):
        if now.stage == "shear" and len(children) < 2:
            child = os.fork()
            if child == 0 and children:
                os._exit(0)
            children.append(child)

    parent = os.getpid()
    try:
        test = tiny.run(tiny.case(), tmp_path / "run", interval=0, progress=fork)
    except RuntimeError as error:
        assert os.getpid() != parent
        os._exit(3 if "forked inside of a callback" in str(error) else 4)
    assert [os.waitpid(child, 0)[1] >> 8 for child in children] == [3, 0]
    assert test.state_hash == bits


def test_specimen_first(tmp_path, bits):
    test = tiny.run(tiny.case(), tmp_path / "run", specimen_only=True)
    assert not test.is_complete and "peak_shear_stress_kPa" not in test.summary and test.status["state"] == "specimen ready"
    assert tiny.run(tiny.case(), tmp_path / "other", specimen=tmp_path / "run").state_hash == bits


def test_branched_from_another_test(tmp_path, finished):
    case = finished.case
    case.update({"shear.normal_stress": "80 kPa", "shear.displacement": "1.3 mm"})
    said = []
    test = dem4grm.run(case, tmp_path / "loaded", threads=1, source=finished.path, message=lambda text, _: said.append(text))
    assert test.summary["branch"]["state_hash"] == finished.state_hash and any("consolidates" in text for text in said)
    assert test.shear["displacement_mm"].size == 130
    case["seed"] = 4
    with pytest.raises(dem4grm.CaseError, match="seed = 3 -> 4: may change at no stored point"):
        tiny.run(case, tmp_path / "other", source=finished.path)
    assert not (tmp_path / "other").exists()
