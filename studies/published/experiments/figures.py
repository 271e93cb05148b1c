"""The published figures as measurements: which experiment gave each, and how sure it is.

Tables II, IV and V print 28 figures beside their depths:

    8   percentages: arithmetic on the others
    8   of the torsion compensator, whose gains and motor the paper does not state:
        printed beside ours, but no evidence of the rig
    8   of the plastisol and its drive: damping in a slow turn at rest (4), settling and
        integral of the base-only turn (4)
    4   of another material: the torque that gelatin holds

No spread is printed for any. A column of Table II has its own: the scatter about the
line through the origin for which the model (7) takes it. So Table II cannot test that
line. Tables IV and V get their rounding and 5 % of the figure, a choice of this project:
it is what a damping that scatters as Table II does at these depths (7 %) makes of them.
Figures count as independent, though settling and integral at one depth are read from
one curve (the mean of three trials).
"""

import math
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from models import published
from models.materials import slope_per_mm

FRACTION = 0.05  # of a figure of Tables IV and V: one standard deviation
_BASE_ONLY = 0


class Experiment(StrEnum):
    """What was done to the needle."""

    SLOW_TURN = "slow turn at rest"
    """90 deg over 20 s, 23 cm free, no axial motion (Section II-A)."""
    BRISK_TURN = "turn at rest in 2 s"
    """The slow turn, ten times faster; the paper has none."""
    HELD_TURN = "slow turn at rest, held"
    """The slow turn, then the base held for 10 s."""
    RELEASE = "slow turn, held, retracted"
    """The held turn, then a retraction by 5 mm (Section II-B3)."""
    QUICK_TURN = "quick turn, sliding"
    """90 deg as the base goes, the needle retracting at 2.5 mm/s (Section II-C)."""


class Measure(StrEnum):
    """What was read off."""

    DAMPING = "damping"
    """Mean base torque over turning rate in the second half of a turn at rest, N mm s."""
    LAG = "lag"
    """Base less tip at the end of the slow turn, deg."""
    HELD_TORQUE = "held torque"
    """Mean base torque while the base is held, N mm."""
    LAG_LEFT = "share of the lag left"
    """Lag after the retraction over lag before it."""
    SETTLING = "settling"
    """Time until the tip stays within 3 deg of 90 deg, s."""
    INTEGRAL = "integral"
    """Of 90 deg less the tip, over 2 s, signed, s deg."""


@dataclass(frozen=True, kw_only=True)
class Figure:
    """One published figure.

    Attributes:
      source: where it is printed.
      spread: one standard deviation, in the figure's unit; `why` says where it is from.
    """

    source: str
    experiment: Experiment
    measure: Measure
    depth_mm: float
    value: float
    unit: str
    spread: float
    why: str

    @property
    def name(self) -> str:
        """Source, measure and depth."""
        return f"{self.source}, {self.measure.value}, {self.depth_mm / 10:g} cm"


def scatter(by_depth_cm: dict[float, float]) -> float:
    """Standard deviation of a column of Table II about its line through the origin."""
    slope = slope_per_mm(by_depth_cm)
    missed = [value - slope * 10 * depth for depth, value in by_depth_cm.items()]
    return float(np.sqrt(np.square(missed).sum() / (len(missed) - 1)))


def gelatin() -> tuple[Figure, ...]:
    """The torque that gelatin holds, at four depths."""
    column = dict(published.STATIC_TORQUE_GELATIN_N_MM)
    return _table_ii(column, Experiment.HELD_TURN, Measure.HELD_TORQUE, "N mm")


def plastisol(fraction: float = FRACTION) -> tuple[Figure, ...]:
    """Damping at four depths, settling and integral of the base-only turn at two.

    Args:
      fraction: of a figure of Tables IV and V that counts as one standard deviation.
    """
    column = dict(published.DAMPING_PLASTISOL_N_MM_S)
    turns = (
        ("Table IV", Measure.SETTLING, published.TABLE_IV_SETTLE_S, "s", 0.01),
        ("Table V", Measure.INTEGRAL, published.TABLE_V_INTEGRAL_DEG_S, "s deg", 0.1),
    )
    return (
        *_table_ii(column, Experiment.SLOW_TURN, Measure.DAMPING, "N mm s"),
        *(
            Figure(
                source=source,
                experiment=Experiment.QUICK_TURN,
                measure=measure,
                depth_mm=10 * depth,
                value=row[_BASE_ONLY],
                unit=unit,
                spread=math.hypot(fraction * row[_BASE_ONLY], digit / math.sqrt(12)),
                why=f"{100 * fraction:g} % and rounding",
            )
            for source, measure, table, unit, digit in turns
            for depth, row in table.items()
        ),
    )


def _table_ii(
    column: dict[float, float], experiment: Experiment, measure: Measure, unit: str
) -> tuple[Figure, ...]:
    return tuple(
        Figure(
            source="Table II",
            experiment=experiment,
            measure=measure,
            depth_mm=10 * depth,
            value=value,
            unit=unit,
            spread=scatter(column),
            why="scatter of the column about its line through the origin",
        )
        for depth, value in column.items()
    )
