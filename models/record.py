"""Frozen, keyword-only configuration records whose errors name the wrong field."""

import re
from collections.abc import Mapping
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError

from models.errors import InvalidValue
from models.suggestion import did_you_mean

_NUMBERS = ("float_parsing", "int_parsing", "float_type", "int_type")
_MAPPINGS = ("model_type", "model_attributes_type", "dict_type")
_COMMA = re.compile(r"\s*[-+]?\d+,\d+\s*")
_WITH_UNIT = re.compile(r"\s*([-+]?\d+([.,]\d+)?)\s*[^\d\s].*")


class Record(BaseModel):
    """A validated, immutable set of named values, units in the names.

    Raises:
      InvalidValue: names the field, what was expected, what was found and how to fix it.
    """

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, use_attribute_docstrings=True
    )

    def __init__(self, /, **values: Any) -> None:
        try:
            super().__init__(**values)
        except ValidationError as error:
            raise _explained(type(self), error) from None

    def but(self, **changes: Any) -> Any:
        """A copy with some fields changed, validated again; itself where none differs."""
        own = {name: vars(self)[name] for name in type(self).__pydantic_fields__}
        if all(name in own and own[name] == value for name, value in changes.items()):
            return self
        return type(self)(**{**own, **changes})


def _explained(record: type[BaseModel], error: ValidationError) -> InvalidValue:
    """The first of pydantic's errors as an `InvalidValue`."""
    first = error.errors()[0]
    cause = first.get("ctx", {}).get("error")
    if isinstance(cause, InvalidValue):
        path = ".".join(str(p) for p in first["loc"])
        inner = cause.field.split(".", 1)[-1] if cause.field[0].isupper() else cause.field
        twice = path.rpartition(".")[2] == inner  # the check of one field names it itself
        field = (path if twice else f"{path}.{inner}") if path else cause.field
        return InvalidValue(field, cause.found, cause.expected, cause.fix)
    field = ".".join(str(p) for p in (record.__name__, *first["loc"]))
    if first["type"] == "missing":
        return InvalidValue(field, None, "a value", _meant(error, first) or "this field has no default")
    if first["type"] in ("extra_forbidden", "unexpected_keyword_argument"):
        return InvalidValue(field, first["input"], *_of_unknown_field(record, first))
    return InvalidValue(field, first["input"], *_of_wrong_value(error, first))


def _of_unknown_field(record: type[BaseModel], first: Mapping[str, Any]) -> tuple[str, str]:
    """What was expected in place of a field that is not known, and the fix."""
    if first["type"] != "extra_forbidden":
        return "a field that is known here", "remove it"
    known = sorted(record.model_fields)
    fix = did_you_mean(first["loc"][-1], known) or "remove it"
    return "one of the fields " + ", ".join(known), fix


def _of_wrong_value(error: ValidationError, first: Mapping[str, Any]) -> tuple[str, str]:
    """What was expected in place of a value that is not allowed, and the fix."""
    found, more = first["input"], _more(error)
    if first["type"] in _NUMBERS:
        return "a number", _number(found) or more
    if first["type"] in _MAPPINGS:
        fix = "indent its fields below its name" if found is None else more
        return "fields with values, as 'name: value'", fix
    return first["msg"].removeprefix("Input should be ").removeprefix("Value error, "), more


def _meant(error: ValidationError, missing: Mapping[str, Any]) -> str:
    """The field beside a missing one that was probably meant for it."""
    *place, name = missing["loc"]
    beside = [
        one["loc"][-1]
        for one in error.errors()
        if one["type"] == "extra_forbidden" and [*one["loc"][:-1]] == place
    ]
    near = [one for one in beside if did_you_mean(one, [name])]
    return f"{near[0]!r} looks like it: rename it" if near else ""


def _number(found: Any) -> str:
    """How a number that was written as text is written; empty: it is none."""
    text = str(found)
    if _COMMA.fullmatch(text):
        return f"write it with a point: {text.strip().replace(',', '.')}"
    with_unit = _WITH_UNIT.fullmatch(text)
    if with_unit:
        return (
            f"write the number alone, in the unit of the field's name: {with_unit[1].replace(',', '.')}"
        )
    return ""


def _more(error: ValidationError) -> str:
    more = error.error_count() - 1
    return f"and {more} more field{'s are' if more > 1 else ' is'} wrong" if more else ""
