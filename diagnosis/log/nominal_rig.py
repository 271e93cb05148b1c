"""`rig.yaml`: the nominal model, as the experimenter states it."""

from collections.abc import Mapping
from typing import Literal

from pydantic import Field

from models.needle import Needle, NonNegative, Positive
from models.record import Record


class NominalNeedle(Record):
    """The nominal needle."""

    diameter_mm: Positive
    shear_modulus_gpa: Positive
    density_g_cm3: Positive


class NominalTissue(Record):
    """The nominal tissue."""

    damping_n_mm_s_per_mm: Positive


class NominalInertia(Record):
    """Inertia in addition to that of the shaft, about its axis."""

    base_kg_m2: NonNegative = 0.0
    """Between the torque sensor and the shaft."""
    tip_kg_m2: NonNegative = 0.0
    """Fixed to the tip."""


class SensorNoise(Record):
    """Claimed standard deviation of each sensor's noise."""

    tip_angle_noise_deg: NonNegative
    base_torque_noise_n_mm: NonNegative
    base_angle_noise_deg: NonNegative

    def by_column(self) -> dict[str, float]:
        """Standard deviation by the column of the sensor."""
        return {
            "base_angle_deg": self.base_angle_noise_deg,
            "base_torque_n_mm": self.base_torque_noise_n_mm,
            "tip_angle_deg": self.tip_angle_noise_deg,
        }

    def scaled(self, factors: Mapping[str, float]) -> "SensorNoise":
        """The claims times factors, by the column of the sensor."""
        own = {column: factors.get(column, 1.0) * claim for column, claim in self.by_column().items()}
        return SensorNoise(
            tip_angle_noise_deg=own["tip_angle_deg"],
            base_torque_noise_n_mm=own["base_torque_n_mm"],
            base_angle_noise_deg=own["base_angle_deg"],
        )


class TrialEntry(Record):
    """The file of a trial."""

    file: str


class NominalRig(Record):
    """All of `rig.yaml`."""

    format: Literal["rig-log/1"]
    needle: NominalNeedle
    tissue: NominalTissue
    inertia: NominalInertia = NominalInertia()
    sensors: SensorNoise
    trials: tuple[TrialEntry, ...] = Field(min_length=1)

    @property
    def rigidity_n_mm2(self) -> float:
        """Nominal torsional rigidity kappa = J G, N mm^2."""
        return Needle(**dict(self.needle)).rigidity_n_mm2
