"""True damping / nominal damping."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, scale: float) -> RigParameters:
    return replace(rig, damping_scale=rig.damping_scale * scale)


EFFECT = Effect(
    name="damping_error",
    title="a wrong damping of the tissue",
    place=Place.PARAMETERS,
    parameters=(
        Parameter(
            name="scale", unit="-", low=0.1, high=10.0, start=(0.8, 1.25), logarithmic=True, neutral=1.0
        ),
    ),
    apply=_apply,
    remedy="set tissue.damping_n_mm_s_per_mm in rig.yaml to {constant}",
    corrects="tissue.damping_n_mm_s_per_mm",
    check=(
        "turn at two steady rates: the difference of the torques over that of the rates and over "
        "the inserted length is the damping"
    ),
)
