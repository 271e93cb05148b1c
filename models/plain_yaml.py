"""YAML as plain values: the one reader of every YAML file that a user provides.

YAML allows aliases, which let a small file expand to a huge one; duplicate keys, of which the last
wins; and tags, which may contradict the text of a value. No protocol, `rig.yaml` or mapping needs
these: all are refused before any object is built.
"""

import binascii
from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any, TypeVar

import yaml

from models.errors import InvalidValue
from models.record import Record
from models.user_text import unprintable

R = TypeVar("R", bound=Record)

MOST_BYTES = 1_000_000
MOST_LEVELS = 10
"""Physical: a file has a few kB and five levels; what is larger is another file, or harmful."""

_STRING = "tag:yaml.org,2002:str"
_WRONG_TEXT = (ValueError, LookupError, ArithmeticError, TypeError, AttributeError, binascii.Error)
"""What PyYAML raises where a text is no value of its tag."""


class _Loader(getattr(yaml, "CSafeLoader", yaml.SafeLoader)):  # type: ignore[misc]
    """The safe loader; its errors name the line of the wrong value."""

    def construct_object(self, node: yaml.Node, deep: bool = False) -> Any:
        try:
            return super().construct_object(node, deep=deep)
        except _WRONG_TEXT as error:
            kind = node.tag.rpartition(":")[2]
            problem = f"not a valid {kind}: {str(node.value)[:40]}"
            raise yaml.constructor.ConstructorError(None, None, problem, node.start_mark) from error


def read_yaml(path: Path, *, expected: str) -> dict[str, Any]:
    """The fields of a YAML file.

    Args:
      expected: what the file should be, in words, for the error message.

    Raises:
      InvalidValue: names the file, the line if one is at fault, and how to fix it.
    """
    text = _text(path, expected)
    try:
        _refuse_huge(path, text)
        loader = _Loader(text)
        node = loader.get_single_node()
        _refuse_odd(path, node)
        content = None if node is None else loader.construct_document(node)
    except (ValueError, RecursionError, yaml.YAMLError) as error:
        if isinstance(error, InvalidValue):
            raise
        raise InvalidValue(_place(path, error), _short(error), "readable YAML") from error
    if not isinstance(content, dict):
        found = "an empty file" if content is None else content
        raise InvalidValue(str(path), found, expected)
    return content


def read_record(path: Path, kind: type[R], content: Mapping[str, Any]) -> R:
    """Build a record from the fields of a file.

    Raises:
      InvalidValue: names the file and the field.
    """
    try:
        record = kind(**content)
    except InvalidValue as error:
        field = error.field.removeprefix(f"{kind.__name__}.")
        raise InvalidValue(f"{path}: {field}", error.found, error.expected, error.fix) from error
    _refuse_yes_for_a_number(path, content, record, "")
    return record


def _refuse_yes_for_a_number(path: Path, given: Any, built: Any, field: str) -> None:
    """Refuse YAML's `yes`, `no`, `on` and `off` for numbers; pydantic would make them 1 and 0."""
    if isinstance(given, bool) and isinstance(built, float):
        raise InvalidValue(f"{path}: {field}", given, "a number")
    if isinstance(given, Mapping):
        inner = dict(built) if isinstance(built, Record | Mapping) else getattr(built, "__dict__", {})
        pairs = [(name, given[name], inner[name]) for name in given if name in inner]
    elif isinstance(given, list) and isinstance(built, tuple):
        pairs = [(str(i), *pair) for i, pair in enumerate(zip(given, built, strict=True))]
    else:
        return
    for name, own, made in pairs:
        _refuse_yes_for_a_number(path, own, made, f"{field}.{name}" if field else name)


def _text(path: Path, expected: str) -> str:
    try:
        with path.open("rb") as file:
            data = file.read(MOST_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InvalidValue(str(path), reason.lower(), expected) from error
    if len(data) > MOST_BYTES:
        raise InvalidValue(str(path), "a larger file", f"at most {MOST_BYTES} bytes; {expected}")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        found = data[error.start : error.start + 4]
        raise InvalidValue(f"{path}, line {line}", found, "text in UTF-8", "save it as UTF-8") from error


def _refuse_huge(path: Path, text: str) -> None:
    """Refuse a file that expands too far, from its parse events, before any object is built."""
    depth = 0
    for event in yaml.parse(text, Loader=_Loader):
        place = f"{path}, {_line(event)}"
        opens, closes = yaml.CollectionStartEvent, yaml.CollectionEndEvent
        depth += isinstance(event, opens) - isinstance(event, closes)
        if depth > MOST_LEVELS:
            raise InvalidValue(place, depth, f"at most {MOST_LEVELS} levels")
        anchor = getattr(event, "anchor", None)
        if anchor is not None:
            fix = "write the value out in each place"
            raise InvalidValue(place, anchor[:40], "plain values, no anchor or alias", fix)


def _refuse_odd(path: Path, node: yaml.Node | None) -> None:
    """Refuse keys that are not text, duplicate keys, and text that cannot be displayed."""
    if isinstance(node, yaml.MappingNode):
        _refuse_odd_names(path, [key for key, _ in node.value])
        for _, value in node.value:
            _refuse_odd(path, value)
    elif isinstance(node, yaml.SequenceNode):
        for value in node.value:
            _refuse_odd(path, value)
    elif isinstance(node, yaml.ScalarNode) and unprintable(node.value):
        raise InvalidValue(
            f"{path}, {_line(node)}", unprintable(node.value), "text without control characters"
        )


def _refuse_odd_names(path: Path, keys: list[yaml.Node]) -> None:
    for key in keys:
        if key.tag != _STRING or unprintable(key.value):
            fix = "put it in quotation marks if it is one"
            shown = key.value if isinstance(key, yaml.ScalarNode) else "a collection"
            raise InvalidValue(f"{path}, {_line(key)}", shown, "the name of a field before ':'", fix)
    for one, other in pairwise(sorted(keys, key=lambda key: str(key.value))):
        if one.value == other.value:
            place = f"{path}, {_line(other)}"
            raise InvalidValue(place, one.value[:40], "each name once, not twice", "remove one")


def _line(marked: yaml.Event | yaml.Node) -> str:
    return f"line {marked.start_mark.line + 1}" if marked.start_mark else "somewhere"


def _place(path: Path, error: Exception) -> str:
    mark = getattr(error, "problem_mark", None)
    return f"{path}, line {mark.line + 1}" if mark else str(path)


def _short(error: Exception) -> str:
    problem = getattr(error, "problem", None)
    return " ".join(str(problem or error).split())[:300]
