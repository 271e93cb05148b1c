"""How one value of a protocol varies in a campaign: on a grid, or drawn for every case."""

from typing import Annotated, Any

import numpy as np
from pydantic import Field, model_validator

from models.errors import InvalidValue
from models.record import Record

_STEPS, _DRAWS = ("grid", "linspace"), ("uniform", "log_uniform", "normal", "choice")


class Variation(Record):
    """Exactly one of these fields is given; values are in the unit of what varies."""

    grid: Annotated[tuple[Any, ...], Field(min_length=1)] | None = None
    """Each of these values."""
    linspace: tuple[float, float, Annotated[int, Field(ge=1)]] | None = None
    """First value, last value, number of values."""
    uniform: tuple[float, float] | None = None
    """Least and largest."""
    log_uniform: tuple[float, float] | None = None
    """Least and largest, above 0; its logarithm is uniform."""
    normal: tuple[float, float] | None = None
    """Mean and standard deviation."""
    choice: Annotated[tuple[Any, ...], Field(min_length=1)] | None = None
    """One of these, each as likely."""

    @model_validator(mode="after")
    def _is_one_and_possible(self) -> "Variation":
        given = [name for name in (*_STEPS, *_DRAWS) if getattr(self, name) is not None]
        if len(given) != 1:
            raise InvalidValue("vary", given, "exactly one of " + ", ".join((*_STEPS, *_DRAWS)))
        for name in ("uniform", "log_uniform"):
            if (ends := getattr(self, name)) and not ends[0] < ends[1]:
                raise InvalidValue(name, ends, "two numbers, the lower one first")
        if self.log_uniform and self.log_uniform[0] <= 0:
            raise InvalidValue("log_uniform", self.log_uniform, "values above 0")
        if self.normal and self.normal[1] <= 0:
            raise InvalidValue("normal", self.normal, "a standard deviation above 0")
        return self

    @property
    def steps(self) -> tuple[Any, ...] | None:
        """The values of a grid; None: drawn."""
        if self.linspace:
            first, last, count = self.linspace
            return tuple(float(value) for value in np.linspace(first, last, count))
        return self.grid

    @property
    def support(self) -> tuple[Any, ...]:
        """Values that have to be possible: all of a grid, the ends of a range, the mean of a normal."""
        ends = self.steps or self.choice or self.uniform or self.log_uniform
        return ends or (self.normal or ())[:1]

    def drawn(self, rng: np.random.Generator) -> Any:
        """Draw a value from the distribution."""
        if self.uniform:
            return float(rng.uniform(*self.uniform))
        if self.log_uniform:
            return float(np.exp(rng.uniform(*np.log(self.log_uniform))))
        if self.normal:
            return float(rng.normal(*self.normal))
        values = self.choice or ()
        return values[int(rng.integers(len(values)))]
