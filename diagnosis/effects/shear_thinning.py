"""Viscous torque as a power of the rate, nominal at 1 rad/s.

A power below 1 would be infinitely viscous at rest. Every fluid, and every simulation,
has a plateau at low rates; the rate at which it begins is fitted, too.
"""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, exponent: float, plateau: float = 1e-5) -> RigParameters:
    return replace(rig, rate_exponent=exponent, plateau_rad_s=plateau)


EFFECT = Effect(
    name="shear_thinning",
    title="shear thinning (or thickening) of the viscous torque",
    place=Place.INTERFACE,
    parameters=(
        Parameter(
            name="exponent",
            unit="-",
            low=0.2,
            high=2.0,
            start=(0.85, 0.6, 1.2),
            neutral=1.0,
            least_factor=0.01,
        ),
        Parameter(
            name="plateau",
            unit="rad/s",
            low=1e-5,
            high=0.1,
            start=(0.003, 0.003, 0.003),
            logarithmic=True,
            reported=False,
            neutral=None,
        ),
    ),
    apply=_apply,
    remedy=(
        "let the viscous torque of the model grow with the rate to the power of {exponent}, "
        "nominal at 1 rad/s"
    ),
    other_forms=("friction over rate",),
    check=(
        "turn at three steady rates: on logarithmic axes the slope of torque over rate is the exponent"
    ),
)
