"""Results of the cross-check: bounds that hold or fail, and published figures beside computed ones."""

import math
from dataclasses import asdict, dataclass, field
from enum import StrEnum
from typing import Any

import pandas as pd

from sim.recording.html_table import html_table


def _or_none(value: Any) -> Any:
    """None instead of NaN, which JSON does not have."""
    return None if isinstance(value, float) and math.isnan(value) else value


@dataclass(frozen=True, kw_only=True)
class Check:
    """A measured value and its bounds; `why` states where the bounds come from."""

    name: str
    value: float
    unit: str
    low: float = float("-inf")
    high: float = float("inf")
    why: str = ""

    @property
    def passed(self) -> bool:
        """Whether the value lies within its bounds; a NaN does not."""
        return bool(self.low <= self.value <= self.high)

    @property
    def bounds(self) -> str:
        """The bounds as text, for example `<= 0.02`."""
        if self.low == float("-inf"):
            return f"<= {self.high:g}"
        return f">= {self.low:g}" if self.high == float("inf") else f"{self.low:g} .. {self.high:g}"


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """A published figure beside the computed one. It is only shown: nothing is tuned to it."""

    item: str
    published: float
    ours: float
    unit: str
    source: str
    note: str = ""

    @property
    def ratio(self) -> float:
        """Computed / published; NaN if the published figure is 0."""
        return self.ours / self.published if self.published else float("nan")


class PoleSource(StrEnum):
    """The needle in MuJoCo from which a pole was measured."""

    SECOND_ORDER = "second_order"
    """Ours, with the step that is corrected to second order: the default."""
    FIRST_ORDER = "first_order"
    """Ours, with MuJoCo's own step, to which only the tissue's torque is added."""
    NATIVE = "without_callbacks"
    """MuJoCo's own springs and dampers, without a callback."""

    @property
    def words(self) -> str:
        """The source in words."""
        return self.value.replace("_", " ")


@dataclass(frozen=True, kw_only=True)
class Pole:
    """A pole measured from MuJoCo beside its closed form, rad/s.

    Attributes:
      bound: largest relative error that is accepted.
    """

    length_mm: float
    free_mm: float
    drive: str
    mode: int
    measured: float
    closed_form: float
    source: PoleSource
    bound: float

    @property
    def error(self) -> float:
        """Relative difference to the closed form."""
        return abs(self.measured / self.closed_form - 1.0)


@dataclass(frozen=True, kw_only=True)
class Findings:
    """All results of `needle validate`."""

    poles: list[Pole] = field(default_factory=list)
    checks: list[Check] = field(default_factory=list)
    comparisons: list[Comparison] = field(default_factory=list)

    @property
    def passed(self) -> bool:
        """Whether every bound holds."""
        return all(check.passed for check in self.checks)

    def _repr_html_(self) -> str:
        """Every bound, for a notebook."""
        rows = {
            c.name: (c.value, c.bounds, c.unit, "holds" if c.passed else "fails") for c in self.checks
        }
        shown = pd.DataFrame.from_dict(rows, orient="index", columns=["measured", "must be", "unit", ""])
        return html_table("every bound holds" if self.passed else "a bound fails", shown)

    def as_json(self) -> dict[str, Any]:
        """Plain values: `passed`, `poles`, `checks`, `comparisons`."""
        return {
            "format": "needle-validate/1",
            "passed": self.passed,
            "poles": [asdict(pole) for pole in self.poles],
            "checks": [
                {
                    "name": c.name,
                    "value": c.value,
                    "unit": c.unit,
                    "bounds": c.bounds,
                    "passed": c.passed,
                    "why": c.why,
                }
                for c in self.checks
            ],
            "comparisons": [
                {k: _or_none(v) for k, v in (asdict(c) | {"ratio": c.ratio}).items()}
                for c in self.comparisons
            ],
        }
