"""The start of a trial whose recording began late: twisted, or moving."""

from collections.abc import Mapping
from dataclasses import dataclass

from diagnosis.criteria.residuals import TURNING_DEG_S

_TOLD_S = 0.01  # of readings that are not used


@dataclass(frozen=True, kw_only=True)
class LateStart:
    """The first sample of a trial that began late.

    Attributes:
      twist_deg: lead of the base over the tip, from the readings; 0: they do not tell.
      rate_deg_s: rate of the base.
      unused_s: time from the first sample for which sensor readings are not used.
    """

    twist_deg: float
    rate_deg_s: float
    unused_s: float

    @property
    def words(self) -> str:
        """The twist, the rate if the base moves, and the unused time, in words."""
        rate_deg_s = abs(self.rate_deg_s)
        moving = f" and moving at {rate_deg_s:.0f} deg/s" if rate_deg_s > TURNING_DEG_S else ""
        twist = f"by about {abs(self.twist_deg):.2g} deg" if self.twist_deg else ""
        unused = f" (its first {self.unused_s:.2g} s are not used)" if self.unused_s >= _TOLD_S else ""
        return f"{twist}{moving}{unused}".removeprefix(" and").strip()


def late_start_warning(starts: Mapping[str, LateStart]) -> str:
    """A warning about trials that began late, by name; empty if none did."""
    if not starts:
        return ""
    each = "; ".join(f"{trial} {start.words}" for trial, start in starts.items())
    return f"begins twisted or moving: {each}; the earlier turn of the base is fitted"
