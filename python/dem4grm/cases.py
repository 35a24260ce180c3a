# SPDX-License-Identifier: BSD-3-Clause
"""Cases: read, change, check, write."""
from __future__ import annotations

import difflib
import json
import tomllib
from collections.abc import Iterator, Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from . import _core

_DENSITY, _FRICTION = "specimen.relative_density", "specimen.preparation_friction"
EXCLUDED = {_DENSITY: _FRICTION, _FRICTION: _DENSITY}  # a change of one takes back a change of the other


def _as_text(value: Any) -> str:
    """A value as `--set` takes it: text as it is, numbers with all their digits, lists as TOML."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(json.dumps(item) if isinstance(item, str) else _as_text(item) for item in value) + "]"
    if hasattr(value, "item"):  # numbers of NumPy
        return _as_text(value.item())
    return repr(value)


class Case:
    """A case of a test, complete and checked at any time: a change that the command line would refuse raises and changes nothing.

    Keys are those of the case file with their section ("shear.normal_stress", docs/reference/case-file.md); values of a dimension
    are text with a unit ("60 kPa").

        case = Case.read("quick.toml")
        case["shear.normal_stress"] = "60 kPa"
        case.update({"specimen.rubber_content": 0.4, "seed": 7})
        case.si("shear.normal_stress")        # 60000.0
        case.write("mine.toml")
    """

    def __init__(self, text: str, name: str | PathLike = "case.toml", changes: Mapping[str, Any] | None = None):
        """From the text of a case file; `name` stands for the file in messages, and what it names is looked for in its folder.

        Raises CaseError with all problems at once.
        """
        self._text, self._name = text, Path(name)
        self._changes: dict[str, str] = {key: _as_text(value) for key, value in (changes or {}).items()}
        self._loaded = self._load(self._changes)

    @classmethod
    def read(cls, path: str | PathLike, changes: Mapping[str, Any] | None = None) -> Case:
        """Reads a case file, with changes like `--set` of the command line.

        Raises MissingFileError when it is not there, CaseError with every problem, each with line and column.
        """
        pairs = [(key, _as_text(value)) for key, value in (changes or {}).items()]
        case = cls.__new__(cls)
        case._loaded = _core.load_case(Path(path), pairs)
        case._text, case._name, case._changes = case._loaded.source_text, Path(path), dict(pairs)
        return case

    @classmethod
    def new(cls, test: str = "direct_shear", *, vrc: float = 25.0, stress: str = "60 kPa") -> Case:
        """A case of the published model, like `dem4grm new`: test "direct_shear" with rubber content `vrc` (per cent of the solid
        volume) and normal stress, or "grain_compression". Raises CaseError for values that no case may have."""
        return cls(_core.new_case_text(test, vrc, stress), f"{test}.toml")

    def _load(self, changes: Mapping[str, str]) -> _core.LoadedCase:
        return _core.parse_case(self._text, self._name, list(changes.items()))

    # ---- keys --------------------------------------------------------------------------------------------------------
    def __getitem__(self, key: str) -> Any:
        """The value as the case file has it: text with a unit, a number, a truth value or a list; None when it is not set."""
        node: Any = tomllib.loads(self._loaded.resolved_toml)
        for part in key.split("."):
            node = node.get(part) if isinstance(node, dict) else None
        if (node is None or isinstance(node, dict)) and key not in self:
            near = difflib.get_close_matches(key, list(self), 1)
            raise KeyError(f"{key} is no key of a {self.test} case" + (f"; did you mean {near[0]}?" if near else ""))
        return node

    def __setitem__(self, key: str, value: Any) -> None:
        """Raises CaseError, with the message of `--set`, and leaves the case alone when the value is not allowed."""
        self.update({key: value})

    def update(self, changes: Mapping[str, Any]) -> None:
        """Several keys at once, for those that only make sense together. All or none: raises CaseError with every problem.

        One of `specimen.preparation_friction` and `specimen.relative_density`, which exclude each other, takes the place of the other."""
        kept = {key: value for key, value in self._changes.items() if EXCLUDED.get(key) not in changes}
        merged = {**kept, **{key: _as_text(value) for key, value in changes.items()}}
        self._loaded = self._load(merged)
        self._changes = merged

    def __delitem__(self, key: str) -> None:
        """Takes a change back: the key gets the value that it had in the file."""
        if key not in self._changes:
            raise KeyError(f"{key} was not changed")
        rest = {other: value for other, value in self._changes.items() if other != key}
        self._loaded = self._load(rest)
        self._changes = rest

    def __iter__(self) -> Iterator[str]:
        return iter([entry["path"] for entry in self._loaded.keys()])

    def __contains__(self, key: object) -> bool:
        return any(entry["path"] == key for entry in self._loaded.keys())

    def si(self, key: str) -> float | int | list[float] | None:
        """The value of a number in SI units; None for what is no number or is not set. Raises KeyError."""
        return self._loaded.si_value(key)

    def describe(self, key: str) -> str:
        """What a key means, with its unit, its published value and its range. Raises KeyError."""
        for entry in self._loaded.keys():
            if entry["path"] == key:
                return entry["note"] + (f", allowed {entry['range']}" if entry["range"] else "")
        raise KeyError(key)

    # ---- the whole ---------------------------------------------------------------------------------------------------
    @property
    def name(self) -> str:
        return self._loaded.name

    @property
    def test(self) -> str:
        """ "direct_shear" or "grain_compression"."""
        return self._loaded.test

    @property
    def changes(self) -> dict[str, str]:
        """What was changed since the file was read."""
        return dict(self._changes)

    @property
    def warnings(self) -> list[str]:
        """Legal but unusual, in the form of the errors."""
        return list(self._loaded.warnings)

    @property
    def text(self) -> str:
        """Every key with its final value and its meaning, as TOML: the file that `write` writes."""
        return self._loaded.resolved_toml

    def write(self, path: str | PathLike) -> Path:
        """Writes a complete case file that needs no other file and reads as the identical case. Raises OSError."""
        Path(path).write_text(self.text, encoding="utf-8")
        return Path(path)

    def copy(self) -> Case:
        return Case(self._text, self._name, self._changes)

    def facts(self) -> dict[str, Any]:
        """What follows before anything is computed, like `dem4grm check --json`: grains, time step, memory; units in the names.

        Raises CaseError for grains that cannot be drawn."""
        return json.loads(_core.case_facts(self._loaded))

    def forecast(self, seconds: float = 2.0, threads: int | None = None) -> dict[str, Any]:
        """Time and disk that a run takes on this machine, from a trial of about so many seconds; units in the names."""
        return json.loads(_core.forecast(self._loaded, seconds, threads or 0))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Case) and self.text == other.text

    __hash__ = None  # type: ignore[assignment]  # a case can change

    def __repr__(self) -> str:
        return f"<dem4grm.Case '{self.name}', {self.test}>"
