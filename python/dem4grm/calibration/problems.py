# SPDX-License-Identifier: BSD-3-Clause
"""Problems of a file, all at once, each with file, line, column and the line itself, as case files have them."""
from __future__ import annotations

import difflib
import re
from collections.abc import Iterable
from pathlib import Path

from ..errors import CaseError

_HEADER = re.compile(r"^\s*(?P<open>\[\[?)\s*(?P<name>[^\[\]]+?)\s*\]\]?\s*(#.*)?$")
_KEY = re.compile(r"""^\s*(?P<key>"[^"]+"|'[^']+'|[\w.-]+)\s*=\s*""")
Place = tuple[str | int, ...]


def places_of(text: str) -> dict[Place, tuple[int, int]]:
    """Line and column, from 1, of each section and key of a TOML text: ("stage", 0, "trials") → (7, 10)."""
    found: dict[Place, tuple[int, int]] = {}
    counts: dict[Place, int] = {}
    here: Place = ()
    for number, line in enumerate(text.splitlines(), 1):
        if header := _HEADER.match(line):
            here = ()
            parts = [part.strip().strip("\"'") for part in header["name"].split(".")]
            for k, part in enumerate(parts):
                here += (part,)
                if header["open"] == "[[" and k == len(parts) - 1:
                    counts[here] = counts.get(here, -1) + 1
                if here in counts:  # a section of an array lies in the array's last item
                    here += (counts[here],)
            found[here] = (number, line.index("[") + 1)
        elif key := _KEY.match(line):
            found[(*here, key["key"].strip("\"'"))] = (number, key.end() + 1)
    return found


class Problems:
    """Collects what is wrong with a file; `raise_any` reports all of it."""

    def __init__(self, path: Path, text: str):
        self._path, self._lines, self._places = path, text.splitlines(), places_of(text)
        self.found: list[str] = []

    def add(self, place: Place, message: str) -> None:
        """A problem of a section or key; what has no line of its own is shown at what it lies in."""
        while place and place not in self._places:
            place = place[:-1]
        line, column = self._places.get(place, (1, 1))
        text = self._lines[line - 1] if line <= len(self._lines) else ""
        rest = text[column - 1:].split("#")[0].rstrip()
        mark = f"\n    {line} | {text}\n{' ' * len(f'    {line}')} | {' ' * (column - 1)}{'^' * max(1, len(rest))}"
        self.found.append(f"{self._path}:{line}:{column}: error: {message}{mark}")

    def unknown(self, place: Place, section: dict, allowed: Iterable[str], name: str) -> None:
        """Adds a problem for every key of a section that is none of the allowed ones."""
        allowed = list(allowed)
        for key in section:
            if key not in allowed:
                near = difflib.get_close_matches(key, allowed, 1)
                hint = f"; did you mean \"{near[0]}\"?" if near else f"; allowed are {', '.join(allowed)}"
                self.add((*place, key), f"unknown key \"{key}\" in {name}{hint}")

    def raise_any(self) -> None:
        if self.found:
            count = f"{len(self.found)} error{'s' if len(self.found) > 1 else ''}, nothing was run"
            raise CaseError("\n".join([*self.found, count]), self.found)
