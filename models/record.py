"""Frozen, keyword-only configuration records whose errors name the wrong field."""

from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError

from models.errors import InvalidValue
from models.suggestion import did_you_mean


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
    if first["type"] == "extra_forbidden":
        known = sorted(record.model_fields)
        fix = did_you_mean(first["loc"][-1], known) or "remove it"
        return InvalidValue(field, first["input"], "one of the fields " + ", ".join(known), fix)
    if first["type"] == "unexpected_keyword_argument":
        return InvalidValue(field, first["input"], "a field that is known here", "remove it")
    if first["type"] == "missing":
        return InvalidValue(field, None, "a value", "this field has no default")
    message = first["msg"].removeprefix("Input should be ").removeprefix("Value error, ")
    return InvalidValue(field, first["input"], message, _more(error))


def _more(error: ValidationError) -> str:
    more = error.error_count() - 1
    return f"and {more} more fields are wrong" if more else ""
