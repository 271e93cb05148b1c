"""The drive of the base: a servo that sets an angle, or a motor that sets a torque."""

from enum import StrEnum

from pydantic import model_validator

from models.errors import InvalidValue
from models.loosening import Loosening
from models.needle import NonNegative, Positive
from models.record import Record
from models.tissue import Interface


class DriveKind(StrEnum):
    """Which quantity is given at the base."""

    ANGLE = "angle"
    TORQUE = "torque"


class Drive(Record):
    """The drive, the chuck, and the sheath that supports the free shaft."""

    kind: DriveKind = DriveKind.ANGLE
    stiffness_n_mm_per_rad: Positive | None = None
    """Torsion spring between drive shaft and needle; None: rigid."""
    unwinding_ratio: Positive = 1.0
    """Its stiffness where the needle is ahead of the drive, over the other way: of a helical spring."""
    backlash_deg: NonNegative = 0.0
    """Total play between drive shaft and needle."""
    loosens: Loosening | None = None
    """Further play, that opens in time; None: there is none."""
    grip_torque_n_mm: Positive | None = None
    """At which the needle slips in the chuck of a servo, either way; None: never."""
    grip_play_deg: Positive | None = None
    """Between the stops of that slip; None: there are none."""
    grip_stiffness_n_mm_per_rad: NonNegative = 0.0
    """Of a spring that brings back what has slipped."""
    sheath_friction_n_mm_per_mm: NonNegative = 0.0
    """Dry torque per mm of free shaft."""
    in_sheath: tuple[Interface, ...] = ()
    """Further laws over the free length."""
    rotor_inertia_kg_m2: NonNegative = 0.0
    """Of motor and gear, as felt at the needle's base."""
    torque_limit_n_mm: Positive | None = None
    """Most torque that a motor of kind torque gives, either way; None: unlimited."""

    @property
    def rubs_in_sheath(self) -> bool:
        """Whether the free shaft is resisted anywhere along it."""
        return self.sheath_friction_n_mm_per_mm > 0 or bool(self.in_sheath)

    @model_validator(mode="after")
    def _ratio_has_a_spring(self) -> "Drive":
        if self.unwinding_ratio != 1.0 and self.stiffness_n_mm_per_rad is None:
            raise InvalidValue(
                "drive.unwinding_ratio",
                self.unwinding_ratio,
                "1, because the drive is rigid either way",
                "give drive.stiffness_n_mm_per_rad, too",
            )
        return self

    @model_validator(mode="after")
    def _limit_has_a_motor(self) -> "Drive":
        if self.torque_limit_n_mm is not None and self.kind is not DriveKind.TORQUE:
            raise InvalidValue(
                "drive.torque_limit_n_mm",
                self.torque_limit_n_mm,
                "nothing, because drive.kind is angle: its servo holds any torque",
                "take drive.kind: torque",
            )
        return self

    @model_validator(mode="after")
    def _grip_has_a_servo(self) -> "Drive":
        if self.grip_torque_n_mm is not None and self.kind is not DriveKind.ANGLE:
            raise InvalidValue(
                "drive.grip_torque_n_mm",
                self.grip_torque_n_mm,
                "nothing, because drive.kind is torque: the motor turns the needle itself",
                "take drive.kind: angle, or drive.torque_limit_n_mm",
            )
        return self

    @model_validator(mode="after")
    def _stops_have_a_grip(self) -> "Drive":
        grips = self.grip_torque_n_mm is not None
        for field in ("grip_play_deg", "grip_stiffness_n_mm_per_rad"):
            if getattr(self, field) and not grips:
                raise InvalidValue(
                    f"drive.{field}",
                    getattr(self, field),
                    "nothing, because the chuck does not slip",
                    "give drive.grip_torque_n_mm, too",
                )
        return self
