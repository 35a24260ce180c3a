# SPDX-License-Identifier: BSD-3-Clause
"""The errors of the package: one class for each exit code of the command line, with the message that it prints."""
from __future__ import annotations


class Error(Exception):
    """Base of all errors of the package.

    exit_code: what the command line would end with (docs/reference/command-line.md).
    """

    exit_code = 70


class MissedError(Error):
    """A verification or a campaign was carried out and missed its aim."""

    exit_code = 1


class UsageError(Error, ValueError):
    """Something was asked for that makes no sense: an unknown name, a folder that holds another case."""

    exit_code = 64


class CaseError(Error, ValueError):
    """A case, a study or a table that they name is wrong.

    problems: each problem as one text, with file, line, column, value and allowed range; str(error) has them all.
    """

    exit_code = 65

    def __init__(self, message: str, problems: list[str] | None = None):
        super().__init__(message)
        self.problems: list[str] = list(problems or [message])


class MissingFileError(Error, FileNotFoundError):
    """A file that was asked for is not there or cannot be read."""

    exit_code = 66

    def __str__(self) -> str:
        return str(self.args[0])


class InternalError(Error):
    """A rule of the program itself is broken: a bug, please report it."""

    exit_code = 70


class OutOfMemoryError(Error, MemoryError):
    """The machine gives no more memory, or no more threads."""

    exit_code = 71


class FolderInUseError(Error):
    """Another process works in the folder; the message names host and process."""

    exit_code = 73


class IoError(Error, OSError):
    """Writing failed (disk full, no permission), or a file is damaged."""

    exit_code = 74

    def __str__(self) -> str:
        return str(self.args[0])


class Stopped(Error):
    """The run was stopped on request; the same call, or the command line, goes on from its checkpoint.

    exit_code: 75; 130 for a test that keeps no checkpoint and starts anew (grain compression).
    """

    exit_code = 75


class PhysicsError(Error):
    """The watchdog found a value that is no number, a lost grain or a runaway overlap; or there is no equilibrium."""

    exit_code = 76


_CLASSES: dict[int, type[Error]] = {
    kind.exit_code: kind
    for kind in (MissedError, UsageError, CaseError, MissingFileError, InternalError, OutOfMemoryError, FolderInUseError, IoError,
                 Stopped, PhysicsError)
}
_CLASSES[130] = Stopped


def error_of(code: int, message: str, problems: list[str]) -> Error:
    """The error of an exit code. Called by the extension module."""
    kind = _CLASSES.get(code, Error)
    error = CaseError(message, problems) if kind is CaseError else kind(message)
    error.exit_code = code
    return error
