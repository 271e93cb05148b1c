"""A chuck that works loose: play that opens while the needle turns, as of a set screw.

play(t) = play min(max((t - from) / over, 0), 1)
"""

from models.needle import Positive
from models.record import Record


class Loosening(Record):
    """Play between drive shaft and needle, beside that which is there all the time."""

    play_deg: Positive
    """In all."""
    from_s: float = 0.0
    """When it begins to open, since the start of the run; before that: it is open."""
    over_s: Positive = 0.1
    """In which it opens."""
