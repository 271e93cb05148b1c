"""What a free-form law lets slip: the needle in its chuck, or the tissue in its holder."""

from dataclasses import dataclass, replace

from models.drive import Drive


@dataclass(frozen=True, kw_only=True)
class FreeGrip:
    """A grip that gives way; as it stands, there is none.

    Attributes:
      torque_n_mm: torque at which the needle slips in the chuck (models.drive); None: never.
      play_deg: between the stops of that slip; None: there are none.
      stiffness_n_mm_per_rad: of a spring that brings it back.
      of_tissue: whether it is the tissue in its holder that gives way, not the chuck: as seen from
        the tissue that is the same, and the tip turns with it; exact without friction elsewhere.
    """

    torque_n_mm: float | None = None
    play_deg: float | None = None
    stiffness_n_mm_per_rad: float = 0.0
    of_tissue: bool = False

    def times(self, strength: float) -> "FreeGrip":
        """The grip that gives way so many times as much."""
        return replace(
            self,
            torque_n_mm=weaker(self.torque_n_mm, strength),
            play_deg=None if self.play_deg is None else strength * self.play_deg,
            stiffness_n_mm_per_rad=weaker(self.stiffness_n_mm_per_rad, strength) or 0.0,
        )

    def of(self, drive: Drive) -> Drive:
        """The drive with this grip."""
        grips = self.torque_n_mm is not None
        changed: Drive = drive.but(
            grip_torque_n_mm=self.torque_n_mm,
            grip_play_deg=self.play_deg if grips else None,
            grip_stiffness_n_mm_per_rad=self.stiffness_n_mm_per_rad if grips else 0.0,
        )
        return changed


def weaker(limit: float | None, strength: float) -> float | None:
    """A limit that is so many times lower; None: there is none."""
    return limit / strength if limit is not None and strength > 0 else None
