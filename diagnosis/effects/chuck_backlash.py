"""Play between drive shaft and needle."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, gap: float) -> RigParameters:
    return replace(rig, backlash_deg=gap)


EFFECT = Effect(
    name="chuck_backlash",
    title="play (backlash) in the chuck",
    place=Place.DRIVE,
    parameters=(
        Parameter(name="gap", unit="deg", low=0.02, high=60.0, start=(0.5, 2.0, 8.0), logarithmic=True),
    ),
    apply=_apply,
    remedy="add to the model play of {gap} between drive shaft and needle, or tighten the chuck",
    check=(
        "hold the needle right behind the chuck and turn the base back and forth: the angle that it "
        "turns without torque is the play"
    ),
)
