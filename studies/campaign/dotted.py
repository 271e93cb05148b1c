"""Dotted paths into plain data: `segments.0.turn_deg` is the turn of the first segment."""

from difflib import get_close_matches
from typing import Any

from models.errors import InvalidValue


def replaced(content: Any, path: str, value: Any) -> Any:
    """A copy of nested mappings and lists with one value replaced.

    Raises:
      InvalidValue: there is nothing at the path; names what there is.
    """
    return _replaced(content, path.split("."), path, value)


def _replaced(content: Any, keys: list[str], path: str, value: Any) -> Any:
    if not keys:
        return value
    key, *rest = keys
    if isinstance(content, dict) and key in content:
        return {**content, key: _replaced(content[key], rest, path, value)}
    if isinstance(content, list | tuple) and key.isdigit() and int(key) < len(content):
        at = int(key)
        return [*content[:at], _replaced(content[at], rest, path, value), *content[at + 1 :]]
    raise _nothing_there(content, key, path)


def _nothing_there(content: Any, key: str, path: str) -> InvalidValue:
    field = f"vary.{path}"
    if isinstance(content, dict):
        close = get_close_matches(key, list(content), n=1)
        fix = f"did you mean {close[0]!r}?" if close else ""
        return InvalidValue(field, key, "one of " + ", ".join(map(str, content)), fix)
    if isinstance(content, list | tuple):
        return InvalidValue(field, key, f"a position from 0 to {len(content) - 1}")
    return InvalidValue(field, key, f"the path to end before it, at the value {content!r}")
