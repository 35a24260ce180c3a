# SPDX-License-Identifier: BSD-3-Clause
"""The table of a comparison: what differs, by how much, and how much it may."""


class Report:
    """Rows of quantity, other program, difference and limit."""

    def __init__(self):
        self._rows, self._notes = [], []

    def row(self, quantity, program, difference, limit):
        # A value that is no number compares false and so does not pass.
        self._rows.append((quantity, program, difference, limit, difference <= limit))

    def note(self, text):
        self._notes.append(text)

    def is_empty(self):
        return not self._rows

    def passed(self):
        return all(row[-1] for row in self._rows)

    def print(self):
        width = max([len(row[0]) for row in self._rows], default=20)
        print(f"{'quantity':{width}}  {'against':10}{'difference':>12}{'limit':>10}")
        for quantity, program, difference, limit, passed in self._rows:
            print(f"{quantity:{width}}  {program:10}{difference:12.2e}{limit:10.1e}  {'' if passed else 'MISS'}")
        for note in self._notes:
            print(note)
        missed = sum(not row[-1] for row in self._rows)
        print(f"{len(self._rows)} quantities, {missed} beyond their limit")
