# SPDX-License-Identifier: BSD-3-Clause
"""Folders of runs as objects (docs/reference/output-folder.md)."""
from __future__ import annotations

import io
import json
import subprocess
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import Any

import h5py
import numpy
import pandas
from numpy.typing import NDArray

from . import _core
from .cases import Case
from .errors import MissingFileError, error_of
from .micro import MicroAnalysis
from .program import program

REACH_MM = 0.05  # how far a stored state may be from the displacement that is asked for


def _open_file(path: Path) -> h5py.File:
    if not path.exists():
        raise MissingFileError(f"{path}: there is no such file; the run has not stored a state yet, or this is no folder of a run")
    _core.check_seal(path)  # IoError for a file that was damaged or changed since the run wrote it
    # Reading needs no lock, which not every file system grants.
    return h5py.File(path, "r", locking=False)


def _word(value: Any) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)


class Group(Mapping):
    """The datasets of one group of a stored state, read when they are asked for: group["normal_force"], or group.normal_force.

    SI units; `units` and `descriptions` say of what. Arrays: one row an item, [n] or [n, 3].
    """

    def __init__(self, file: Path, group: str):
        self._file, self._group = file, group

    def _attributes(self, name: str) -> dict[str, str]:
        with _open_file(self._file) as file:
            return {key: _word(file[self._group][key].attrs[name]) for key in file[self._group]}

    def __getitem__(self, name: str) -> NDArray:
        with _open_file(self._file) as file:
            group = file[self._group]
            if name not in group:
                raise KeyError(f"{name}; there are {', '.join(group)}")
            values = group[name][:]
        return values.astype(str) if values.dtype.kind == "S" else values

    def __getattr__(self, name: str) -> NDArray:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError as error:
            raise AttributeError(str(error)) from None

    def __iter__(self) -> Iterator[str]:
        with _open_file(self._file) as file:
            return iter(list(file[self._group]))

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self]

    @cached_property
    def units(self) -> dict[str, str]:
        return self._attributes("unit")

    @cached_property
    def descriptions(self) -> dict[str, str]:
        return self._attributes("description")

    def frame(self) -> pandas.DataFrame:
        """All datasets as columns; vectors as name_x, name_y, name_z. Units in attrs["units"]."""
        columns: dict[str, NDArray] = {}
        units: dict[str, str] = {}
        for name in self:
            values = self[name]
            parts = {name: values} if values.ndim == 1 else {
                f"{name}_{axis}": values[:, k] for k, axis in zip(range(values.shape[1]), "xyz" if values.shape[1] < 4 else "wxyz")}
            columns.update(parts)
            units.update(dict.fromkeys(parts, self.units[name]))
        lengths = {len(values) for values in columns.values()}
        if len(lengths) > 1:  # names beside the items
            longest = max(lengths)
            columns = {name: values for name, values in columns.items() if len(values) == longest}
        table = pandas.DataFrame(columns)
        table.attrs["units"] = {name: units[name] for name in columns}
        return table

    def __repr__(self) -> str:
        return f"<dem4grm {self._group} of {self._file}: {', '.join(self)}>"


class State:
    """A full state of a test: groups balls, bonds, clumps, contacts, rubber_grains, walls, read from HDF5 when asked for."""

    def __init__(self, file: Path, name: str, facts: Mapping[str, Any]):
        self._file, self.name = file, name
        self.displacement: float = float(facts["displacement"])  # m
        self.state_hash: str = _word(facts["state_hash"])
        self.time: float = float(facts["time"])  # s, simulated
        self.step: int = int(facts["step"])
        self.time_step: float = float(facts["time_step"])  # s

    @property
    def displacement_mm(self) -> float:
        return self.displacement * 1e3

    def _group(self, name: str) -> Group:
        return Group(self._file, f"frames/{self.name}/{name}")

    @property
    def balls(self) -> Group:
        """All balls: position (m), velocity (m/s), radius (m), body, material (0 gravel, 1 rubber)."""
        return self._group("balls")

    @property
    def bonds(self) -> Group:
        """The 64 bonds of every rubber grain: length (m), forces (N), moment (N m), is_broken."""
        return self._group("bonds")

    @property
    def clumps(self) -> Group:
        """The gravel grains: position, velocity, spin, orientation (w, x, y, z), mass, sieve_size, shape."""
        return self._group("clumps")

    @property
    def contacts(self) -> Group:
        """Contacts that carry force, with walls too: bodies, point, normal from i to j, normal_force, shear_force on i, ..."""
        return self._group("contacts")

    @property
    def rubber_grains(self) -> Group:
        return self._group("rubber_grains")

    @property
    def walls(self) -> Group:
        return self._group("walls")

    def micro(self, *, bins: int = 36, level: str = "contact", mean: str = "orientations", strong: str = "normal",
              projection: str = "all", resamples: int = 0, seed: int = 1) -> MicroAnalysis:
        """The micro-mechanics of the state, like `dem4grm micro`; options as of dem4grm.micro.analyse."""
        return MicroAnalysis(
            *_core.analyse_state(self._file, self.displacement, bins, level, mean, strong, projection, resamples, seed))

    def __repr__(self) -> str:
        return f"<dem4grm.State {self.name} at {self.displacement_mm:.3f} mm of {self._file}>"


class States(Mapping):
    """The stored states of a test by displacement in mm: test.states[8.0]; the nearest one within 0.05 mm counts."""

    def __init__(self, file: Path):
        with _open_file(file) as opened:
            frames = opened["frames"] if "frames" in opened else {}
            self._states = [State(file, name, dict(frames[name].attrs)) for name in sorted(frames)]

    def __getitem__(self, displacement_mm: float) -> State:
        near = min(self._states, key=lambda state: abs(state.displacement_mm - displacement_mm), default=None)
        if near is None or abs(near.displacement_mm - displacement_mm) > REACH_MM:
            known = ", ".join(f"{state.displacement_mm:.3f}" for state in self._states)
            raise KeyError(f"no state at {displacement_mm} mm; there are {known or 'none'}")
        return near

    def __iter__(self) -> Iterator[float]:
        return iter([state.displacement_mm for state in self._states])

    def __len__(self) -> int:
        return len(self._states)

    @property
    def first(self) -> State:
        return self._states[0]

    @property
    def last(self) -> State:
        return self._states[-1]


class Test:
    """The folder of a run, finished or not. Tables have the columns of the files, units in the names and in attrs["units"]."""

    __test__ = False  # for pytest

    def __init__(self, folder: str | PathLike, was_complete: bool | None = None):
        """was_complete: whether dem4grm.run found the test finished; None when the folder was opened otherwise.

        Raises MissingFileError when the folder is none of a run."""
        self.path = Path(folder)
        self.was_complete = was_complete
        if not (self.path / "resolved.toml").exists():
            raise MissingFileError(f"{self.path}: no output folder of a run (it has no resolved.toml)")

    # ---- what was run ------------------------------------------------------------------------------------------------
    @cached_property
    def case(self) -> Case:
        """The complete case, to be changed and run again."""
        return Case.read(self.path / "resolved.toml")

    @property
    def kind(self) -> str:
        """ "direct_shear" or "grain_compression"."""
        return tomllib.loads((self.path / "resolved.toml").read_text(encoding="utf-8")).get("test", "direct_shear")

    @property
    def is_complete(self) -> bool:
        return (self.path / "summary.json").exists()

    @property
    def status(self) -> dict[str, Any]:
        """status.json: where the run stands, while it runs too."""
        return self._json("status.json")

    @property
    def summary(self) -> dict[str, Any]:
        """summary.json: all numbers of a finished test; of one that ends with its specimen, specimen.json. Units in the names."""
        return self._json("summary.json" if self.is_complete else "specimen.json")

    @property
    def state_hash(self) -> str:
        """Fingerprint of the last state: equal hashes, equal bits."""
        return self.summary["state_hash"]

    @property
    def log(self) -> str:
        return (self.path / "run.log").read_text(encoding="utf-8")

    def _json(self, name: str) -> dict[str, Any]:
        path = self.path / name
        if not path.exists():
            raise MissingFileError(f"{path}: there is no such file; the run is not finished" if name == "specimen.json" else
                                   f"{path}: there is no such file")
        return json.loads(path.read_text(encoding="utf-8"))

    # ---- tables ------------------------------------------------------------------------------------------------------
    def _table(self, name: str, group: str) -> pandas.DataFrame:
        path = self.path / name
        if not path.exists():
            raise MissingFileError(f"{path}: there is no such file; this is a {self.kind} test")
        table = pandas.read_csv(path, float_precision="round_trip")
        units, descriptions = {}, {}
        if (self.path / "results.h5").exists():  # an unfinished run has no tables there yet
            with _open_file(self.path / "results.h5") as file:
                for column in file[group] if group in file else ():
                    units[column] = _word(file[group][column].attrs["unit"])
                    descriptions[column] = _word(file[group][column].attrs["description"])
        table.attrs.update(units=units, descriptions=descriptions)
        return table

    @property
    def shear(self) -> pandas.DataFrame:
        """shear.csv: stresses (kPa), dilation (mm), void ratio, energies (J), ... over displacement_mm."""
        return self._table("shear.csv", "shear")

    @property
    def walls(self) -> pandas.DataFrame:
        """walls.csv: forces (N) of the grains on each wall over displacement_mm."""
        return self._table("walls.csv", "walls")

    @property
    def micro(self) -> pandas.DataFrame:
        """micro.csv: fabric, force anisotropy, strong network, strain of the rubber over displacement_mm."""
        return self._table("micro.csv", "micro")

    @property
    def profiles(self) -> pandas.DataFrame:
        """profiles.csv: displacement, rotation, density over the height, for each state."""
        return self._table("profiles.csv", "profiles")

    @property
    def compression(self) -> pandas.DataFrame:
        """grain.csv of a grain compression: load (N), strain, Poisson's ratio, ..."""
        return self._table("grain.csv", "compression")

    # ---- states ------------------------------------------------------------------------------------------------------
    @property
    def states(self) -> States:
        """Full states by displacement in mm. Raises MissingFileError when none is stored yet."""
        return States(self.path / "results.h5")

    def sieve(self, openings_mm: Sequence[float] = ()) -> pandas.DataFrame:
        """Simulated sieve analysis of the specimen, like `dem4grm sieve`: sieve_mm and per cent passing, measured and asked.

        openings_mm: of the sieves; by default those of the input gradings. Key figures in attrs["figures"].
        Raises UsageError for a test without a specimen."""
        text, table = _core.sieve(self.path, [opening * 1e-3 for opening in openings_mm])
        frame = pandas.read_csv(io.StringIO(table), float_precision="round_trip")
        frame.attrs["figures"] = json.loads(text)
        return frame

    def report(self, output: str | PathLike | None = None, *, laboratory: Sequence[str | PathLike] = ()) -> Path:
        """One HTML page that shows the test, like `dem4grm report`; returns its path, by default report.html in the folder.

        laboratory: CSV files with a laboratory's curves, drawn beside ours. Raises MissingFileError for a program that carries no page
        and for a file that is not there, CaseError for a curve that cannot be read."""
        path = Path(output) if output is not None else self.path / "report.html"
        words = [str(program()), "report", str(self.path), "-q", "-o", str(path)]
        for file in laboratory:
            words += ["--lab", str(file)]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise error_of(done.returncode, done.stderr.removeprefix("error: ").strip(), [])
        return path

    def __repr__(self) -> str:
        state = "complete" if self.is_complete else self.status.get("state", "unfinished")
        return f"<dem4grm.Test {self.path}, {self.kind}, {state}>"


def open(folder: str | PathLike) -> Test:  # noqa: A001  # pylint: disable=redefined-builtin
    """The folder of a run as an object. Raises MissingFileError when it is none."""
    return Test(folder)
