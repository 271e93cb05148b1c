"""What turns the base: a servo that sets an angle, or a motor that sets a torque."""

from enum import StrEnum

from models.needle import NonNegative, Positive
from models.record import Record


class DriveKind(StrEnum):
    """Which quantity at the base is given."""

    ANGLE = "angle"
    TORQUE = "torque"


class Drive(Record):
    """The drive, the chuck, and the sheath that supports the free shaft."""

    kind: DriveKind = DriveKind.ANGLE
    stiffness_n_mm_per_rad: Positive | None = None
    """Torsion spring between drive shaft and needle; None: rigid."""
    backlash_deg: NonNegative = 0.0
    """Total play between drive shaft and needle."""
    sheath_friction_n_mm_per_mm: NonNegative = 0.0
    """Dry torque per mm of free shaft."""
