"""The exceptions of the library: they say what was expected, what was found and how to fix it."""

from pathlib import PurePath
from typing import Any

from models.suggestion import did_you_mean

_MOST_SHOWN = 500  # characters of a value in a message


class NeedleError(Exception):
    """Base of every error that this library raises on purpose."""


class InvalidValue(NeedleError, ValueError):
    """A field holds a value that it may not have.

    Args:
      field: the field, as the user wrote it.
      found: the offending value.
      expected: what would be accepted.
      fix: how to fix it; empty when `expected` says it all.
    """

    def __init__(self, field: str, found: Any, expected: str, fix: str = "") -> None:
        self.field, self.found, self.expected, self.fix = field, found, expected, fix
        message = f"{field}: expected {expected}, found {_shown(found)}"
        super().__init__(message + (f"; {fix}" if fix else ""))

    def __reduce__(self) -> tuple[Any, ...]:
        # Exceptions are copied as type(*args), and args is the message alone.
        return _restored, (type(self), self.field, self.found, self.expected, self.fix)


class UnknownName(InvalidValue):
    """A name that is not known; the message suggests the one that was probably meant, then lists all."""

    def __init__(self, field: str, found: Any, known: Any) -> None:
        names = ", ".join(sorted(map(str, known)))
        if meant := did_you_mean(found, known):
            super().__init__(field, found, "a known name", f"{meant} Known: {names}")
        else:
            super().__init__(field, found, f"one of {names}")


class OutputExists(NeedleError):
    """An output path exists, and overwriting was not allowed."""


class UnsafeOutput(NeedleError):
    """An output path is or leads to a file of the user's, which no option overwrites."""


class UnwritableOutput(NeedleError):
    """The system cannot write an output: the disk is full, or the path is unsuitable."""


class EnvironmentMismatch(NeedleError):
    """An installed package is not the one that this library was built for."""


def _shown(value: Any) -> str:
    """A value for a message: paths as plain text, all else by `repr`; long values are cut."""
    if value is None:
        return "nothing"
    shown = str(value) if isinstance(value, PurePath) else repr(value)
    return shown if len(shown) <= _MOST_SHOWN else f"{shown[:_MOST_SHOWN]} ..."


def _restored(kind: type[InvalidValue], *fields: Any) -> InvalidValue:
    """An error of a kind from its fields, without its constructor: for errors of other processes."""
    error = kind.__new__(kind)
    InvalidValue.__init__(error, *fields)
    return error
