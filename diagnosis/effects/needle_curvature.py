"""A bent shaft prefers one orientation."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, torque: float, phase: float) -> RigParameters:
    return replace(rig, curvature_n_mm_per_mm=torque, curvature_phase_deg=phase)


EFFECT = Effect(
    name="needle_curvature",
    title="a bent shaft",
    place=Place.NEEDLE,
    parameters=(
        Parameter(
            name="torque",
            unit="N mm / mm",
            low=1e-05,
            high=0.05,
            start=(0.001, 0.001, 0.001, 0.001),
            logarithmic=True,
        ),
        Parameter(
            name="phase",
            unit="deg",
            low=-360.0,
            high=360.0,
            start=(0.0, 90.0, 180.0, -90.0),
            scale=10.0,
            period=360.0,
            neutral=None,
        ),
    ),
    apply=_apply,
    remedy="use a straight needle, or add to the model a torque of {torque} times the sine of the angle "
    "from {phase} on",
    check="turn slowly by a full turn: the torque of a bent shaft swings once in a turn",
)
