# SPDX-License-Identifier: BSD-3-Clause
"""A real Slurm on this machine: one controller and two node daemons on the loopback, in a folder that vanishes.

    with SlurmCluster() as cluster:
        cluster.run("sbatch", "job.sh")

Needs Debian's slurm-wlm and munge, and root, since a node daemon starts jobs as their user. Nothing of a Slurm that the machine
may have already is touched: own key, own sockets, own ports, own configuration.
"""
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import tempfile
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol", "scancel", "sinfo")

CONFIGURATION = """
ClusterName=loopback
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=5
CryptoType=crypto/munge
SlurmctldPort={ports[0]}
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmdSpoolDir={folder}/spool-%n
StateSaveLocation={folder}/state
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0,sched_min_interval=0
SlurmctldTimeout=5
SlurmdTimeout=5
KillWait=5
MinJobAge=5
BatchStartTimeout=5
ReturnToService=2
MaxArraySize={largest}
MpiDefault=none
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[1]} CPUs=2 RealMemory=4000
NodeName=n2 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[2]} CPUs=2 RealMemory=4000
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def reason_against():
    """Why no cluster can be started here; empty when one can, which is tried."""
    missing = [p for p in PROGRAMS if find(p) is None]
    if missing:
        return f"these programs of Debian's slurm-wlm and munge are missing: {', '.join(missing)}"
    if os.geteuid() != 0:
        return "only root may start the node daemons of a cluster"
    try:
        with SlurmCluster():
            return ""
    except (OSError, RuntimeError, TimeoutError) as error:
        return f"the daemons do not come up: {error}"


def find(program):
    return shutil.which(program, path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin")


def free_ports(n):
    sockets = [socket.socket() for _ in range(n)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


def is_alive(process):
    """False also for a process that ended and whose parent has not asked for its end."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


def parent_of(process):
    try:
        return int(pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[1])
    except OSError:
        return 0


def words_of(process):
    try:
        return pathlib.Path(f"/proc/{process}/cmdline").read_bytes().decode(errors="replace").replace("\0", " ")
    except OSError:
        return ""


class SlurmCluster:
    NODES = ("n1", "n2")

    def __init__(self, largest_array=11):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="dem4grm-cluster-"))
        self.configuration = self.folder / "slurm.conf"
        self.environment = {**os.environ, "SLURM_CONF": str(self.configuration),
                            "PATH": os.environ.get("PATH", "") + ":/usr/sbin:/sbin"}
        self.largest_array = largest_array

    def __enter__(self):
        try:
            self.start()
        except BaseException:
            self.stop()
            raise
        return self

    def __exit__(self, *_):
        self.stop()

    # ---- daemons

    def start(self):
        (self.folder / "state").mkdir()
        self.folder.chmod(0o755)
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        self.configuration.write_text(CONFIGURATION.format(folder=self.folder, host=socket.gethostname(),
                                                           ports=free_ports(3), largest=self.largest_array))
        self.run("munged", f"--key-file={key}", f"--socket={self.folder}/munge.socket",
                 f"--pid-file={self.folder}/munged.pid", f"--log-file={self.folder}/munged.log",
                 f"--seed-file={self.folder}/munge.seed", "--force")
        self.start_controller()
        for node in self.NODES:
            self.start_node(node)
        self.wait_for(lambda: self.run("sinfo", "-h", "-t", "idle", "-o", "%D").strip() == "2", 20, "two idle nodes")

    def start_controller(self):
        self.run("slurmctld")
        self.wait_for(lambda: "UP" in self.run("scontrol", "ping", check=False), 20, "the controller")

    def start_node(self, node):
        self.run("slurmd", "-N", node)

    def stop_controller(self):
        """As its administrator would: it saves what it knows. Killed, it would forget what came in its last seconds."""
        process = int((self.folder / "slurmctld.pid").read_text())
        os.kill(process, signal.SIGTERM)
        self.wait_for(lambda: not is_alive(process), 20, "the controller to stop")

    def kill_node(self, node):
        """The machine of a node is lost: nothing there has time for a last word, so those that would speak die first."""
        jobs = [p for p in self.processes() if f"n={node}" in self.variables_of(p)]
        for process in {parent_of(p) for p in jobs}:
            if words_of(process).startswith("slurmstepd"):
                self.end(process)
        self.kill(f"slurmd-{node}.pid")
        for process in jobs:
            self.end(process)

    def stop(self):
        for name in ("slurmctld.pid", *(f"slurmd-{n}.pid" for n in self.NODES), "munged.pid"):
            self.kill(name)
        for process in self.processes():
            self.end(process)
        shutil.rmtree(self.folder, ignore_errors=True)

    # ---- processes

    def variables_of(self, process):
        """Environment of a process, with the node of its job as n=NAME."""
        try:
            text = pathlib.Path(f"/proc/{process}/environ").read_bytes().decode(errors="replace")
        except OSError:
            return []
        variables = text.split("\0")
        return variables + [f"n={v.split('=', 1)[1]}" for v in variables if v.startswith("SLURMD_NODENAME=")]

    def processes(self):
        """Everything that belongs to this cluster: daemons, job steps and jobs carry its configuration."""
        own = os.getpid()
        mark = f"SLURM_CONF={self.configuration}"
        numbers = [int(p.name) for p in pathlib.Path("/proc").iterdir() if p.name.isdigit()]
        return [p for p in numbers if p != own and mark in self.variables_of(p)]

    @staticmethod
    def end(process):
        try:
            os.kill(process, signal.SIGKILL)
        except ProcessLookupError:
            pass

    def kill(self, name):
        path = self.folder / name
        try:
            process = int(path.read_text())
        except (OSError, ValueError):
            return
        self.end(process)
        path.unlink(missing_ok=True)
        deadline = time.monotonic() + 5
        while is_alive(process) and time.monotonic() < deadline:
            time.sleep(0.02)

    # ---- words

    def run(self, *command, check=True, **options):
        words = [find(command[0]) or command[0], *map(str, command[1:])]
        done = subprocess.run(words, env=self.environment, text=True, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)
        if check and done.returncode != 0:
            raise RuntimeError(f"{' '.join(map(str, command))} ended with {done.returncode}: {done.stdout}")
        return done.stdout

    def elements(self):
        """State of every element of the queue by JOB_INDEX."""
        lines = self.run("squeue", "-h", "-r", "-o", "%F_%K|%T|%r").splitlines()
        return {line.split("|")[0]: line.split("|")[1:] for line in lines}

    @staticmethod
    def wait_for(condition, seconds, what, every=0.1):
        deadline = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > deadline:
                raise TimeoutError(f"waited {seconds} s for {what}")
            time.sleep(every)
