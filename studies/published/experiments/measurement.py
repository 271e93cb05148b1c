"""A measurement: a quantity of one experiment at one depth."""

from dataclasses import dataclass
from enum import StrEnum


class TurnExperiment(StrEnum):
    """The experiment: how the needle was moved."""

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


class Quantity(StrEnum):
    """The quantity that was measured."""

    DAMPING = "damping"
    """Mean base torque over turning rate in the second half of a turn at rest, N mm s."""
    LAG = "lag"
    """Base minus tip at the end of the slow turn, deg."""
    HELD_TORQUE = "held torque"
    """Mean base torque while the base is held, N mm."""
    LAG_LEFT = "share of the lag left"
    """Lag after the retraction over lag before it."""
    SETTLING = "settling"
    """Time until the tip stays within 3 deg of 90 deg, s."""
    ERROR_LEFT = "error left"
    """90 deg minus the tip when the observation of a quick turn ends, deg."""
    INTEGRAL = "integral"
    """Of 90 deg minus the tip, over 2 s, signed, s deg."""


@dataclass(frozen=True, kw_only=True)
class TurnMeasurement:
    """A quantity of one experiment at one depth.

    Attributes:
      sigma: one standard deviation, in `unit`.
    """

    experiment: TurnExperiment
    quantity: Quantity
    depth_mm: float
    unit: str
    sigma: float


@dataclass(frozen=True, kw_only=True)
class MeasuredFigure(TurnMeasurement):
    """A measurement with the value that the paper gives.

    Attributes:
      source: where it is printed.
      value: in `unit`.
      sigma_source: origin of the standard deviation, in words.
    """

    source: str
    value: float
    sigma_source: str

    @property
    def name(self) -> str:
        """Source, quantity and depth."""
        return f"{self.source}, {self.quantity.value}, {self.depth_mm / 10:g} cm"
