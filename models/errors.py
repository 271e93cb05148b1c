"""The exceptions of the library: what was wrong, what came, and the way out."""

from typing import Any


class NeedleError(Exception):
    """Base of every error that this library raises on purpose."""


class InvalidValue(NeedleError, ValueError):
    """A field holds a value that it may not have.

    Args:
      field: the field, as the user wrote it.
      got: the offending value.
      expected: what would be accepted.
      fix: the way out; empty when `expected` says it all.
    """

    def __init__(self, field: str, got: Any, expected: str, fix: str = "") -> None:
        self.field, self.got, self.expected, self.fix = field, got, expected, fix
        super().__init__(f"{field}: expected {expected}, got {got!r}" + (f"; {fix}" if fix else ""))


class UnknownName(InvalidValue):
    """A name that is not among the known ones."""

    def __init__(self, field: str, got: Any, known: Any) -> None:
        super().__init__(field, got, "one of " + ", ".join(sorted(map(str, known))))


class OutputExists(NeedleError):
    """An output path exists and was not to be overwritten."""


class EnvironmentMismatch(NeedleError):
    """An installed package is not the one that this library was built for."""
