"""Two layers of different damping, with the nominal total."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, ratio: float, boundary: float) -> RigParameters:
    return replace(rig, layer_ratio=ratio, layer_boundary_fraction=boundary)


EFFECT = Effect(
    name="layered_tissue",
    title="tissue in two layers of different damping",
    place=Place.TISSUE,
    parameters=(
        Parameter(
            name="ratio",
            unit="-",
            low=0.02,
            high=50.0,
            start=(3.0, 0.33, 3.0, 0.33),
            logarithmic=True,
            neutral=1.0,
        ),
        Parameter(
            name="boundary", unit="-", low=0.1, high=0.9, start=(0.35, 0.35, 0.65, 0.65), neutral=None
        ),
    ),
    apply=_apply,
    remedy=(
        "model two layers of tissue that meet at {boundary} of the inserted length, the deep one "
        "with {ratio} times the damping of the shallow one"
    ),
    other_forms=("damping over position", "damping over position, in layers"),
    check="repeat one turn at several depths: the torque per mm changes where a layer begins",
)
