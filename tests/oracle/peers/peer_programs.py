# SPDX-License-Identifier: BSD-3-Clause
"""How LAMMPS and YADE are started, and how their results are read."""
import csv
import math
import pathlib
import shutil
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
WALL_FORCES = ("displacement", "lid", "floor", "x_low", "x_high", "y_low", "y_high")


def read_table(path):
    with open(path, encoding="utf-8") as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


def write_table(path, names, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, names)
        table.writeheader()
        table.writerows(rows)
    return rows


def run(command, folder, log):
    """Runs a program; its output goes to the log, and the end of that into the error if it fails."""
    with open(folder / log, "w", encoding="utf-8") as file:
        done = subprocess.run([str(word) for word in command], cwd=folder, stdout=file, stderr=subprocess.STDOUT,
                              check=False)
    if done.returncode != 0:
        tail = (folder / log).read_text(encoding="utf-8", errors="replace")[-2000:]
        raise RuntimeError(f"{command[0]} ended with {done.returncode}:\n{tail}")


class Lammps:
    """Pair style granular; "hertz/material" between spheres, stiffnesses as numbers at walls."""

    def __init__(self, executable):
        self._executable = executable

    @staticmethod
    def write_start(folder, name, density):
        rows = read_table(folder / f"{name}.start.csv")
        with open(folder / f"{name}.data", "w", encoding="utf-8") as file:
            file.write(f"{name}\n\n{len(rows)} atoms\n1 atom types\n\n")
            for axis in "xyz":
                low, high = min(row[axis] for row in rows) - 0.1, max(row[axis] for row in rows) + 0.1
                file.write(f"{low} {high} {axis}lo {axis}hi\n")
            file.write("\nAtoms # sphere\n\n")
            for number, row in enumerate(rows, 1):
                file.write(f"{number} 1 {2 * row['radius']!r} {density!r} {row['x']!r} {row['y']!r} {row['z']!r}\n")
            file.write("\nVelocities\n\n")
            for number, row in enumerate(rows, 1):
                file.write(f"{number} {row['vx']!r} {row['vy']!r} {row['vz']!r} 0 0 0\n")
        return f"{name}.data"

    @staticmethod
    def law(section, rule, restitution):
        """Variables that describe the contact law. The damping of LAMMPS is not exactly 0 at restitution 1."""
        young, nu = section["young"], section["poisson"]
        effective, effective_shear = young / (2 * (1 - nu**2)), young / (4 * (2 - nu) * (1 + nu))
        damping, value = ("tsuji", restitution) if rule == "damped" else ("velocity", 0.0)
        return {"pair_normal": f"hertz/material {young!r} {value!r} {nu!r}",
                "wall_normal": f"hertz {4.0 / 3.0 * effective!r} {value!r}",
                "wall_stiffness": repr(8.0 * effective_shear), "friction": repr(section["friction"]),
                "tangential": "mindlin_rescale/force" if rule == "rescaled" else "mindlin/force", "damping": damping}

    def _start(self, folder, script, name, variables):
        command = [self._executable, "-in", HERE / script, "-log", f"{name}.lammps.log"]
        for key, value in variables.items():
            command += ["-var", key, value]
        run(command, folder, f"{name}.lammps.out")

    def impact(self, folder, name, facts, section):
        variables = self.law(section, facts["rule"], facts["restitution_of_tsuji"])
        variables |= {"wall": int(facts["at_wall"]), "dt": repr(facts["time_step"]), "steps": facts["steps"],
                      "start": self.write_start(folder, name, section["density"]), "result": f"{name}.dump"}
        self._start(folder, "lammps_impact.in", name, variables)
        lines = (folder / f"{name}.dump").read_text(encoding="utf-8").splitlines()
        first = next(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS")) + 1
        names = ("id", "vx", "vy", "vz", "wx", "wy", "wz")
        return write_table(folder / f"{name}.lammps.csv", names,
                           [dict(zip(names, map(float, line.split()))) for line in lines[first:]])

    def compression(self, folder, name, facts, section):
        variables = self.law(section, facts["rule"], facts["restitution_of_tsuji"])
        length, width, height = facts["size"]
        variables |= {"dt": repr(section["time_step"]), "speed": repr(section["lid_speed"]), "length": repr(length),
                      "width": repr(width), "height": repr(height), "every": facts["every"],
                      "samples": section["samples"], "result": f"{name}.lammps",
                      "start": self.write_start(folder, name, section["density"])}
        self._start(folder, "lammps_compression.in", name, variables)
        rows = []
        for line in (folder / f"{name}.lammps").read_text(encoding="utf-8").splitlines():
            if not line.startswith("#"):
                rows.append(dict(zip(WALL_FORCES, (math.fabs(float(word)) for word in line.split()[1:]))))
        rows = [row for row in rows if row["displacement"] > 0.0]
        return write_table(folder / f"{name}.lammps.csv", WALL_FORCES, rows)


class Yade:
    """Hertz-Mindlin (MindlinPhys) and cohesive contacts with moments (CohFrictMat)."""

    def __init__(self, executable):
        self._executable = executable

    def _start(self, folder, script, name, arguments):
        run([self._executable, "-n", "-x", "-j1", HERE / script, HERE / "parameters.json", *arguments], folder,
            f"{name}.yade.out")

    def impact(self, folder, name, _facts, _section):
        self._start(folder, "yade_impact.py", name, [f"{name}.json", f"{name}.start.csv", f"{name}.yade.csv"])
        return read_table(folder / f"{name}.yade.csv")

    def cantilevers(self, folder):
        self._start(folder, "yade_cantilever.py", "cantilever", [folder])

    def compression(self, folder, name, _facts, _section):
        self._start(folder, "yade_compression.py", name, [f"{name}.json", f"{name}.start.csv", f"{name}.yade.csv"])
        return read_table(folder / f"{name}.yade.csv")


KNOWN = {"lammps": ("lmp", Lammps), "yade": ("yade", Yade)}


def found():
    """The programs that are installed."""
    return {name: kind(path) for name, (command, kind) in KNOWN.items() if (path := shutil.which(command))}
