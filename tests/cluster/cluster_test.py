#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Campaigns on a real Slurm: `cluster_test.py DEM4GRM`.

The study of cases/studies/quick.toml, and some smaller ones, through killed nodes, time limits, cancelled elements, a controller that
restarts and a full disk: every test ends done, with the hash that it has without Slurm, or is named with its cause. Ends with 77
and the reason where no cluster can be started; then only the commands of the workstation are tried.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import slurm_cluster

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/docs"))
import snippets  # noqa: E402
PROGRAM = ""

BASE = (ROOT / "cases/studies/small-box.toml").read_text(encoding="utf-8").replace("../gradings", str(ROOT / "cases/gradings"))
DESK = """[[stage]]
case = "{cases}/grain_compression.toml"
trials = 6
start = 3
[stage.set]
"compression.records" = 10
"compression.strain" = 0.1
"compression.plate_velocity" = "100 mm/s"
[[stage.parameter]]
key = "rubber.bond.modulus"
low = "8 MPa"
high = "60 MPa"
[[stage.data]]
quantity = "load_N"
x = "strain"
error = 0.5
values = [[0.05, 3.0], [0.09, 7.0]]
"""
SRUN = """srun -n1 -c1 --quiet sh -c 'echo $SLURM_JOB_ID >> jobs.txt; exec "$@"' run"""
MIXTURES = 'base = "base.toml"\n[axes]\nrubber_content = [0, 0.25]\nnormal_stress = ["50 kPa", "100 kPa"]\n'


def text(path):
    return path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""


def commands_of(page):
    """The commands that a page tells its reader to type, in order."""
    return snippets.commands_of((ROOT / "docs/how-to" / page).read_text(encoding="utf-8"))


def type_commands(page, folder, environment):
    """Runs the commands of a page as its reader would; returns command and output of each."""
    (folder / "bin").mkdir(exist_ok=True)
    for link, target in (("bin/dem4grm", PROGRAM), ("cases", ROOT / "cases"), ("tools", ROOT / "tools")):
        if not (folder / link).is_symlink():
            (folder / link).symlink_to(target)
    path = f"{folder / 'bin'}:{environment['PATH']}"
    outputs = []
    for command in commands_of(page):
        done = subprocess.run(["bash", "-c", command], cwd=folder, env={**environment, "PATH": path}, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        if done.returncode != 0:
            raise AssertionError(f"{page}: {command} ended with {done.returncode}\n{done.stdout}{done.stderr}")
        outputs.append((command, done.stdout))
    return outputs


class Workstation(unittest.TestCase):
    def test_every_command_of_the_page_works(self):
        with tempfile.TemporaryDirectory(prefix="dem4grm-how-to-") as folder:
            outputs = type_commands("campaign-on-a-workstation.md", pathlib.Path(folder), dict(os.environ))
            self.check(outputs)

    def check(self, outputs):
        self.assertIn("6 of 6 done", "".join(out for command, out in outputs if "campaign status" in command))
        self.assertIn("6 of 6 tests collected", dict(outputs)["dem4grm campaign collect runs/quick-study"])


class Campaigns(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="dem4grm-campaigns-"))
        cls.cluster = slurm_cluster.SlurmCluster()
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.addClassCleanup(cls.cluster.stop)
        cls.cluster.start()
        (cls.folder / "base.toml").write_text(BASE, encoding="utf-8")
        cls.begin_over_the_limit()

    def run(self, result=None):
        begin = time.monotonic()
        super().run(result)
        print(f"  {self.id().rsplit('.', 1)[1]}: {time.monotonic() - begin:.0f} s", file=sys.stderr, flush=True)

    # ---- helpers

    @classmethod
    def dem4grm(cls, *words, code=0):
        done = subprocess.run([PROGRAM, *map(str, words)], cwd=cls.folder, env=cls.cluster.environment, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        if code is not None and done.returncode != code:
            raise AssertionError(f"{' '.join(map(str, words))}: ended with {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stdout

    @classmethod
    def write_study(cls, name, body):
        (cls.folder / name).write_text(body, encoding="utf-8")
        return name

    @classmethod
    def submit(cls, study, folder, *more):
        return cls.dem4grm("campaign", "run", study, "-o", folder, "--on", "slurm", "-j", 1, *more)

    @classmethod
    def state_of_tests(cls, folder):
        answer = json.loads(cls.dem4grm("campaign", "status", folder, "--json"))
        return {t["name"]: t for t in answer["state_of_tests"]}

    def hashes(self, folder):
        return {n: t["state_hash"] for n, t in self.state_of_tests(folder).items()}

    def wait_until(self, folder, condition, seconds=120):
        def holds():
            return condition(self.state_of_tests(folder))
        try:
            self.cluster.wait_for(holds, seconds, "the tests", every=0.4)
        except TimeoutError:
            logs = "".join(f"\n{p}:\n{text(p)[-500:]}" for p in sorted((self.folder / folder).glob("slurm/logs/*")))
            self.fail(f"{self.dem4grm('campaign', 'status', folder)}{self.cluster.run('squeue', '-r')}{logs}")

    def wait_for_all(self, folder, seconds=120):
        self.wait_until(folder, lambda tests: all(t["state"] == "done" for t in tests.values()), seconds)

    def elements_of(self, folder):
        """JOB_INDEX of every test, from the record of what was submitted."""
        jobs = json.loads(text(self.folder / folder / "slurm/jobs.json"))["jobs"]
        return {name: f"{j['id']}_{k}" for j in jobs if not j["prepares"] for k, name in enumerate(j["tests"])}

    def wait_for_shear(self, folder, name, seconds=60):
        self.wait_until(folder, lambda tests: tests[name]["stage"] == "shear" and tests[name]["state"] == "running", seconds)

    # ---- over the time limit: begun first, looked at last, since Slurm looks at limits twice a minute only

    @classmethod
    def begin_over_the_limit(cls):
        # So slow that the test takes half a minute on this machine, whatever machine it is, and has others beside it.
        body = 'base = "base.toml"\n[set]\nshear.velocity = "{} mm/s"\n[axes]\nseed = [1]\n'
        study = cls.write_study("limit.toml", body.format(10))
        plan = json.loads(cls.dem4grm("campaign", "plan", study, "--json", "-w", 1, "-j", 1))["tests"][0]
        cls.write_study("limit.toml", body.format(round(10 * plan["forecast_test_s"] / 35, 3)))
        cls.submit(study, "limit", "--time", "1", "--extra=--signal=B:USR1@50")
        cls.reference = subprocess.Popen([PROGRAM, "run", "limit/cases/seed1.toml", "-o", "limit-alone", "-j", "1", "-q"],
                                         cwd=cls.folder)

    def test_9_over_its_time_limit_a_test_goes_back_into_the_queue_until_it_is_done(self):
        self.wait_for_all("limit", 240)
        log = text(self.folder / "limit/slurm/logs/tests-001-0.out")
        self.assertGreaterEqual(log.count("goes back into the queue"), 3, log)
        self.assertEqual(self.reference.wait(), 0)
        alone = json.loads(text(self.folder / "limit-alone/summary.json"))["state_hash"]
        self.assertEqual(self.hashes("limit")["seed1"], alone)

    def hurry_the_limit(self):
        """Two of the signals that Slurm sends ahead of a limit, sent now; the third comes from Slurm itself."""
        for n in (1, 2):
            self.wait_for_shear("limit", "seed1")
            element = self.elements_of("limit")["seed1"]
            self.cluster.run("scancel", "--batch", "--signal=USR1", element)
            log = self.folder / "limit/slurm/logs/tests-001-0.out"
            self.cluster.wait_for(lambda: text(log).count("goes back into the queue") >= n, 30, "a requeue")

    # ---- the scenarios

    def test_1_quick_study_has_the_hashes_of_a_run_without_slurm(self):
        """Every command of both pages, the workstation's in a folder of its own."""
        self.hurry_the_limit()
        here = self.folder / "workstation"
        here.mkdir()
        outputs = dict(type_commands("campaign-on-a-cluster.md", self.folder, self.cluster.environment))
        dry, submitted = [out for command, out in outputs.items() if "--on slurm" in command]
        self.assertIn("#SBATCH --signal=B:USR1@", dry)
        self.assertIn("6 test(s) submitted, 0 in the queue already, 0 done", submitted)
        # While it runs a second call submits nothing.
        self.assertIn("0 test(s) submitted", self.submit("cases/studies/quick.toml", "runs/quick-study"))
        Workstation().check(type_commands("campaign-on-a-workstation.md", here, self.cluster.environment))
        self.wait_for_all("runs/quick-study")
        self.assertEqual(self.hashes("runs/quick-study"), self.hashes("workstation/runs/quick-study"))
        self.assertIn("0 test(s) submitted, 0 in the queue already, 6 done",
                      self.submit("cases/studies/quick.toml", "runs/quick-study"))

    def test_2_a_lost_node_and_a_restarted_controller(self):
        study = self.write_study("lost.toml", MIXTURES.replace("[axes]", '[set]\nshear.velocity = "5 mm/s"\n[axes]'))
        self.submit(study, "lost")
        self.wait_for_shear("lost", "vrc025-100kPa")
        self.cluster.stop_controller()
        victim = self.node_of("lost")
        self.cluster.kill_node(victim)
        self.cluster.start_controller()
        self.wait_for_all("lost", 150)
        self.cluster.start_node(victim)
        self.assertEqual(self.hashes("lost"), self.without_slurm(study, "lost-here"))

    def node_of(self, folder):
        """A node on which a test of the campaign runs."""
        for process in self.cluster.processes():
            if f"{self.folder / folder}/tests" in slurm_cluster.words_of(process):
                return next(v[2:] for v in self.cluster.variables_of(process) if v.startswith("n="))
        self.fail(f"no test of {folder} runs")

    def without_slurm(self, study, folder):
        self.dem4grm("campaign", "run", study, "-o", folder, "-w", 2, "-j", 1, "-q")
        return self.hashes(folder)

    def test_3_a_cancelled_element_is_named_and_goes_on_with_the_next_call(self):
        study = self.write_study("cancel.toml", 'base = "base.toml"\n[set]\nshear.velocity = "5 mm/s"\n[axes]\nseed = [1, 2]\n')
        self.submit(study, "cancel")
        self.wait_for_shear("cancel", "seed2")
        # The last element of an array has the number of the array: its requeue must not be that of all elements.
        self.cluster.run("scancel", "--batch", "--signal=USR1", self.elements_of("cancel")["seed2"])
        logs = [self.folder / f"cancel/slurm/logs/tests-001-{k}.out" for k in (0, 1)]
        self.cluster.wait_for(lambda: text(logs[1]).count("run, start") == 2, 60, "the second start")
        self.wait_for_shear("cancel", "seed2")
        self.cluster.run("scancel", self.elements_of("cancel")["seed2"])
        self.wait_until("cancel", lambda tests: tests["seed2"]["state"] == "stopped")
        self.assertIn("stopped on request", self.state_of_tests("cancel")["seed2"]["cause"])
        self.wait_until("cancel", lambda tests: tests["seed1"]["state"] == "done")
        self.assertEqual(text(logs[0]).count("run, start"), 1, "the other element was left alone")
        self.assertIn("1 test(s) submitted", self.submit(study, "cancel"))
        self.wait_for_all("cancel")
        self.assertEqual(self.hashes("cancel"), self.without_slurm(study, "cancel-here"))

    def test_4_a_full_disk_is_the_cause_of_one_test_and_the_others_go_on(self):
        study = self.write_study("full.toml", 'base = "base.toml"\n[axes]\nseed = [1, 2]\n')
        disk = self.folder / "full/tests/seed1"
        disk.mkdir(parents=True)
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=300k", "none", disk], capture_output=True, text=True)
        if mounted.returncode != 0:
            self.skipTest(f"no small disk can be made here: {mounted.stderr.strip()}")
        try:
            self.submit(study, "full")
            self.wait_until("full", lambda tests: tests["seed1"]["state"] == "failed" and tests["seed2"]["state"] == "done")
            self.assertIn("No space left on device", self.state_of_tests("full")["seed1"]["cause"])
        finally:
            subprocess.run(["umount", disk], check=True)
        self.submit(study, "full")
        self.wait_for_all("full")

    def test_5_chunks_below_the_largest_array(self):
        toy = self.write_study("toys.toml", 'base = "base.toml"\n[set]\nshear.displacement = "0.02 mm"\n'
                                            "recording.frame_interval = \"0.02 mm\"\n"
                                            "rubber_content = 0\n[axes]\nseed = { from = 1, to = 25, step = 1 }\n")
        answer = self.submit(toy, "toys")
        sizes = [int(n) for n in re.findall(r"(\d+) element\(s\)", answer)]
        self.assertEqual(sizes, [self.cluster.largest_array, self.cluster.largest_array, 25 - 2 * self.cluster.largest_array])
        self.wait_for_all("toys")
        self.assertEqual(len(set(self.hashes("toys").values())), 25, "no folder is that of another seed")

    def test_6_the_scripts_run_without_slurm(self):
        study = self.write_study("plain.toml", 'base = "base.toml"\n[axes]\nseed = [1]\n')
        self.submit(study, "plain", "--dry-run")
        environment = {k: v for k, v in os.environ.items() if not k.startswith("SLURM")}
        done = subprocess.run(["bash", self.folder / "plain/slurm/tests-001.sh"], env={**environment, "SLURM_ARRAY_TASK_ID": "0"},
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(self.state_of_tests("plain")["seed1"]["state"], "done")

    def test_8_trials_of_a_calibration_run_through_srun(self):
        package = pathlib.Path(PROGRAM).parents[2] / "python"
        if not (package / "dem4grm").is_dir():
            self.skipTest("built without the Python package")
        (self.folder / "desk.toml").write_text(DESK.format(cases=ROOT / "cases"), encoding="utf-8")
        results = []
        for folder, launcher in (("srun", ["--launcher", SRUN]), ("here", [])):
            done = subprocess.run([sys.executable, "-m", "dem4grm", "calibrate", "desk.toml", "-o", folder, "-w", "2", "-q", *launcher], cwd=self.folder,
                                  env={**self.cluster.environment, "PYTHONPATH": str(package)}, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            results.append((self.folder / folder / "result.json").read_bytes())
        self.assertEqual(*results)
        jobs = text(self.folder / "jobs.txt").split()
        self.assertEqual(len(set(jobs)), json.loads(results[0])["stages"][0]["runs"], "a job for each run")

    def test_7_what_slurm_refuses_is_said_in_its_own_words(self):
        study = self.write_study("refused.toml", 'base = "base.toml"\n[axes]\nseed = [1]\n')
        done = subprocess.run([PROGRAM, "campaign", "run", study, "-o", "refused", "--on", "slurm", "--partition", "nowhere"],
                              cwd=self.folder, env=self.cluster.environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 74)
        self.assertIn("invalid partition specified: nowhere", done.stderr)


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    reason = slurm_cluster.reason_against()
    if reason:
        print(f"no cluster can be started here: {reason}")
        passed = unittest.TextTestRunner(verbosity=2).run(unittest.defaultTestLoader.loadTestsFromTestCase(Workstation))
        sys.exit(77 if passed.wasSuccessful() else 1)
    passed = unittest.TextTestRunner(verbosity=2).run(unittest.defaultTestLoader.loadTestsFromTestCase(Campaigns))
    sys.exit(0 if passed.wasSuccessful() else 1)
