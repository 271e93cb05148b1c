"""The published rig: what the paper states about it, and what a hypothesis may change.

The paper states the needle, the viscous law with b = 3.45 N mm s at 200 mm, and a base that
starts 5 cm from the tissue. The free length of the quick turn can be understood in two
ways: the set-up's 50 mm, or none, as in the model of Sections III and V.
"""

from dataclasses import dataclass
from typing import Any

from diagnosis.log.nominal_rig import NominalRig
from diagnosis.replay.rig_parameters import RigParameters
from models import published
from studies.published.experiments.base_turn import BaseTurn

_SETUP_FREE_MM = 50.0

_STATED: dict[str, Any] = {
    "format": "rig-log/1",
    "needle": {
        "diameter_mm": published.NEEDLE_DIAMETER.value,
        "shear_modulus_gpa": published.NEEDLE_SHEAR_MODULUS.value,
        "density_g_cm3": published.NEEDLE_DENSITY.value,
    },
    "tissue": {"damping_n_mm_s_per_mm": published.DAMPING_200_MM.value / 200},
    "sensors": {
        "tip_angle_noise_deg": 0.6,  # the Hall sensor's resolution (Section II-A)
        "base_torque_noise_n_mm": 0.0,
        "base_angle_noise_deg": 0.0,
    },
    "trials": [{"file": "published"}],
}
STATED = NominalRig(**_STATED)


@dataclass(frozen=True, kw_only=True)
class PublishedRig:
    """One possible form of the published rig; by default the stated one.

    Attributes:
      model: needle, tissue, drive and sensors, as in the diagnosis of rig logs.
      free_mm: free length at the start of the quick turn; 0: none at any time.
      turn: turn of the base in the quick turn.
    """

    model: RigParameters = RigParameters()  # noqa: RUF009 - frozen
    free_mm: float = _SETUP_FREE_MM
    turn: BaseTurn = BaseTurn()  # noqa: RUF009 - frozen


WITH_FREE_LENGTH = PublishedRig()
WITHOUT_FREE_LENGTH = PublishedRig(free_mm=0.0)
STATED_RIGS = (WITH_FREE_LENGTH, WITHOUT_FREE_LENGTH)
"""The stated rig with each free length that the paper can be understood to have."""
