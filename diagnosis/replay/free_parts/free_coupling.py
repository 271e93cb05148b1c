"""What a free-form law has between drive and needle: a spring that is another one as it unwinds."""

from dataclasses import dataclass, replace

from diagnosis.replay.free_parts.free_grip import weaker
from models.drive import Drive


@dataclass(frozen=True, kw_only=True)
class FreeCoupling:
    """A spring in series with that of the rig; as it stands, there is none.

    Attributes:
      stiffness_n_mm_per_rad: where the drive is ahead; None: it is rigid.
      unwinding_ratio: stiffness where the needle is ahead, over that.
    """

    stiffness_n_mm_per_rad: float | None = None
    unwinding_ratio: float = 1.0

    def times(self, strength: float) -> "FreeCoupling":
        """A coupling that gives way so many times as far."""
        return replace(self, stiffness_n_mm_per_rad=weaker(self.stiffness_n_mm_per_rad, strength))

    def of(self, drive: Drive) -> Drive:
        """The drive with this coupling."""
        if self.stiffness_n_mm_per_rad is None:
            return drive
        others = 1.0 / drive.stiffness_n_mm_per_rad if drive.stiffness_n_mm_per_rad else 0.0
        forwards, backwards = (
            1.0 / (others + 1.0 / (ratio * self.stiffness_n_mm_per_rad))
            for ratio in (1.0, self.unwinding_ratio)
        )
        changed: Drive = drive.but(stiffness_n_mm_per_rad=forwards, unwinding_ratio=backwards / forwards)
        return changed
