"""What a free-form law lets come loose in a trial: play in the chuck, from a moment on."""

from dataclasses import dataclass, replace

from models.loosening import Loosening


@dataclass(frozen=True, kw_only=True)
class FreePlay:
    """Play of the chuck in one trial.

    Attributes:
      trial: its name.
      play_deg: in all.
      from_s: when it begins to open, after the start of the trial.
      over_s: in which it opens.
    """

    trial: str
    play_deg: float
    from_s: float
    over_s: float

    def times(self, strength: float) -> "FreePlay":
        """So many times as wide."""
        return replace(self, play_deg=strength * self.play_deg)

    def after(self, past_s: float) -> "FreePlay":
        """As seen from a time so long before the start of the trial."""
        return replace(self, from_s=self.from_s + past_s)

    @property
    def loosening(self) -> Loosening | None:
        """What the chuck does; None: it has no play."""
        if self.play_deg == 0.0:
            return None
        return Loosening(play_deg=self.play_deg, from_s=self.from_s, over_s=self.over_s)
