"""Wording that messages about a log share."""

from collections.abc import Mapping, Sequence

_SHOWN = 4


def listed(names: Mapping[str, float] | Sequence[str]) -> str:
    """The first names, and the number of the others."""
    shown = list(names)[:_SHOWN]
    more = len(names) - len(shown)
    return ", ".join(shown) + (f" and {more} more" if more else "")
