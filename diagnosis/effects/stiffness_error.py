"""True torsional stiffness / nominal stiffness."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, scale: float) -> RigParameters:
    return replace(rig, stiffness_scale=rig.stiffness_scale * scale)


EFFECT = Effect(
    name="stiffness_error",
    title="a wrong torsional stiffness",
    place=Place.PARAMETERS,
    parameters=(
        Parameter(
            name="scale", unit="-", low=0.1, high=10.0, start=(0.9, 1.15), logarithmic=True, neutral=1.0
        ),
    ),
    apply=_apply,
    remedy="set needle.shear_modulus_gpa in rig.yaml to {constant}",
    corrects="needle.shear_modulus_gpa",
    check="twist a known length of the shaft in air and take torque over angle",
)
