"""How a trial begins whose recording began late: twisted, or moving."""

from dataclasses import dataclass

from diagnosis.criteria import TURNING_DEG_S


@dataclass(frozen=True, kw_only=True)
class LateStart:
    """The first sample of a trial that began late.

    Attributes:
      twist_deg: of the base before the tip, as the readings say.
      rate_deg_s: of the base.
      unused_s: from the first sample, that what the sensors read is not used.
    """

    twist_deg: float
    rate_deg_s: float
    unused_s: float

    def warning(self, trial: str) -> str:
        """What was done with the trial, in a sentence of the report."""
        rate_deg_s = abs(self.rate_deg_s)
        moving = f", moving at {rate_deg_s:.0f} deg/s" if rate_deg_s > TURNING_DEG_S else ""
        return (
            f"{trial}: begins wound up by about {abs(self.twist_deg):.2g} deg{moving}: what the base "
            "turned by before is fitted, and what its sensors read in the first "
            f"{self.unused_s:.2g} s is not used"
        )
