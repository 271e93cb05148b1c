"""A chuck that works loose, as by a set screw: play that opens while the needle turns.

Between drive shaft and needle, beside the play that is there all the time, there is at time t

    play min(max((t - from) / over, 0), 1)
"""

from models.needle import Positive
from models.record import Record


class Loosening(Record):
    """Play between drive shaft and needle, beside that which is there all the time."""

    play_deg: Positive
    """In all."""
    from_s: float = 0.0
    """When it begins to open, since the start of the run; negative: before that."""
    over_s: Positive = 0.1
    """In which it opens."""
