"""Effects of the needle that the diagnosis does not model: of its shaft and of its tip."""

import math

from validation.rig.laws.parameters import LawParameters
from validation.rig.unmodelled.effect import Parameters, UnmodelledEffect


def hardening_shaft(law: LawParameters, p: Parameters) -> LawParameters:
    """Torque of the shaft is rigidity * strain (1 + coefficient strain^2), strain in rad/mm."""
    return law._replace(hardening=p["coefficient"])


def permanent_set(law: LawParameters, p: Parameters) -> LawParameters:
    """Beyond `torque` the shaft twists plastically, with linear kinematic hardening of `slope`."""
    return law._replace(yield_torque=p["torque"], yield_slope=p["slope"])


def tip_friction(law: LawParameters, p: Parameters) -> LawParameters:
    """Dry friction in one place, at the tip: the bevel is wedged in the tissue."""
    return law._replace(tip_dry=p["level"])


def tip_in_fibres(law: LawParameters, p: Parameters) -> LawParameters:
    """The bevel prefers to lie along fibres: torque sin(2 (tip angle - phase)) at the tip."""
    return law._replace(fibre=p["torque"], fibre_phase=math.radians(p["phase"]))


HERE = ("needle",)
EFFECTS = {
    "hardening_shaft": UnmodelledEffect(place=HERE, variables=("torque",), law=hardening_shaft),
    "permanent_set": UnmodelledEffect(place=HERE, variables=("torque", "history"), law=permanent_set),
    "tip_friction": UnmodelledEffect(place=HERE, variables=("direction", "rate"), law=tip_friction),
    "tip_in_fibres": UnmodelledEffect(place=HERE, variables=("tip_angle",), law=tip_in_fibres),
}
