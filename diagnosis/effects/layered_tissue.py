"""Two layers of different damping, the total nominal."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.rig_model import RigModel


def _enter(rig: RigModel, ratio: float, boundary: float) -> RigModel:
    return replace(rig, layer_ratio=ratio, layer_boundary=boundary)


EFFECT = Effect(
    name="layered_tissue",
    place=Place.TISSUE,
    parameters=(
        Parameter(
            name="ratio",
            unit="-",
            low=0.05,
            high=20.0,
            start=(3.0, 0.33, 3.0, 0.33),
            logarithmic=True,
            nothing=1.0,
        ),
        Parameter(
            name="boundary", unit="-", low=0.1, high=0.9, start=(0.35, 0.35, 0.65, 0.65), nothing=None
        ),
    ),
    enter=_enter,
)
