"""Two records of parts at once: each part is of the one that has it."""

from collections.abc import Collection
from dataclasses import fields
from typing import Any, TypeVar

from models.errors import InvalidValue

Record = TypeVar("Record")


def merged(
    one: Record, other: Record, added: Collection[str] = (), within: Collection[str] = ()
) -> Record:
    """A record with the parts of both; a part of one that stands as in a new record is none.

    Args:
      added: parts of which one may have several, tuples.
      within: parts that are records themselves.

    Raises:
      InvalidValue: both set a part of which there is one.
    """
    nothing = type(one)()
    found: dict[str, Any] = {}
    for part in fields(one):  # type: ignore[arg-type]
        first, second, none = (getattr(record, part.name) for record in (one, other, nothing))
        if part.name in added:
            found[part.name] = first + second
        elif part.name in within:
            found[part.name] = merged(first, second)
        elif second in (none, first):
            found[part.name] = first
        elif first == none:
            found[part.name] = second
        else:
            raise InvalidValue(part.name, second, f"one law that sets it, and another one sets {first}")
    return type(one)(**found)
