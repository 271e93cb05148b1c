"""Free laws of a tissue in layers: what each mm of shaft meets depends on its depth below the surface.

- dry friction that each layer has
- damping, or dry friction, of one layer, which is thin or thick, anywhere; where the needle slides, also
  friction that is shared with the axial motion
- damping, or the stiffness of elastic tissue, of each layer; only where the inserted length varies: at
  one length these are laws of the place along the shaft (interface.py, tissue.py)
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.interface import PARTS
from diagnosis.freeform.family import VISCOUS, Family, Points, coordinates_of, from_neutral
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, rough_curve, smooth_curve
from diagnosis.replay.along_depth import AlongDepth
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable

SAYS = "position"
FINE = 12  # layers of damping, down to the greatest depth: a thin one shows
_EITHER = {Place.TISSUE: 0.6, Place.INTERFACE: 0.4}
_FRICTION = {Place.INTERFACE: 0.6, Place.TISSUE: 0.4}
_FROM = (0.05, 0.12, 0.2, 0.28, 0.36, 0.44, 0.52, 0.6, 0.7, 0.8, 0.9)
"""Of the greatest depth, where one layer is looked for."""
_THICK, _STEP_MM = 0.1, 1e-3  # of it, and from one layer to the next as it is drawn
_TIMES = (2.0, 0.5)  # its damping / that of the rest


@dataclass(frozen=True, kw_only=True, eq=False)
class _Layers:
    """Equally thick layers, down to the greatest depth of a log, and a curve over them."""

    curve: SmoothCurve
    deepest_mm: float

    @property
    def thickness_mm(self) -> float:
        return self.deepest_mm / self.curve.places.size

    @property
    def middles_mm(self) -> tuple[float, ...]:
        return tuple((i + 0.5) * self.thickness_mm for i in range(self.curve.places.size))


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Families of layers that may be missing."""
    deepest = ranges.deepest_mm
    layers = _Layers(curve=smooth_curve(0.0, 1.0, PARTS), deepest_mm=deepest)
    fine = _Layers(curve=rough_curve(0.0, 1.0, FINE), deepest_mm=deepest)
    slides = Variable.AXIAL_SPEED in ranges.ends
    dry = (
        _one_dry_layer(deepest, ranges, shared=own) for own in ((False, True) if slides else (False,))
    )
    friction = (_friction(layers, ranges), *dry)
    if Variable.DEPTH not in ranges.ends:
        return friction
    return (*friction, _damping(fine, ranges), _elastic(layers, ranges), _one_layer(deepest, ranges))


def _friction(layers: _Layers, ranges: LogRanges) -> Family:
    level = ranges.dry_level
    return Family(
        effect=Effect(
            name="dry friction over position, in layers",
            title="dry friction that changes with the depth below the surface",
            place=Place.INTERFACE,
            parameters=(level, *from_neutral(coordinates_of(layers.curve), level)),
            apply=partial(_apply_friction, layers),
            differences=(1e-2,),
        ),
        places=_FRICTION,
        says=SAYS,
        title="dry friction along the shaft",
        curve=partial(_levels, layers),
        x_unit="mm below the surface",
        unit="N mm / mm",
    )


def _levels(layers: _Layers, level: float, *c: float) -> Points:
    return layers.middles_mm, level * np.array(layers.curve.factors(c))


def _apply_friction(layers: _Layers, rig: RigParameters, level: float, *c: float) -> RigParameters:
    levels = tuple(level * factor for factor in layers.curve.factors(c))
    return _with(rig, AlongDepth(friction_n_mm_per_mm=levels, thickness_mm=layers.thickness_mm))


def _damping(layers: _Layers, ranges: LogRanges) -> Family:
    return Family(
        effect=Effect(
            name="damping over position, in layers",
            title="damping that changes with the depth below the surface",
            place=Place.TISSUE,
            parameters=coordinates_of(layers.curve),
            apply=partial(_apply_damping, layers),
        ),
        places=_EITHER,
        says=SAYS,
        title="damping along the shaft",
        curve=partial(_dampings, layers, ranges.damping_n_mm_s_per_mm),
        x_unit="mm below the surface",
        unit=VISCOUS,
    )


def _dampings(layers: _Layers, beta: float, *c: float) -> Points:
    return layers.middles_mm, beta * np.array(layers.curve.factors(c))


def _apply_damping(layers: _Layers, rig: RigParameters, *c: float) -> RigParameters:
    return _with(rig, AlongDepth(damping=layers.curve.factors(c), thickness_mm=layers.thickness_mm))


def _elastic(layers: _Layers, ranges: LogRanges) -> Family:
    elastic = ranges.library["tissue_viscoelasticity"].parameters
    return Family(
        effect=Effect(
            name="elastic tissue over position, in layers",
            title="elastic tissue that changes with the depth below the surface",
            place=Place.TISSUE,
            parameters=(*elastic, *from_neutral(coordinates_of(layers.curve), elastic[0])),
            apply=partial(_apply_elastic, layers),
        ),
        places={Place.TISSUE: 1.0},
        says=SAYS,
        title="stiffness of the tissue",
        curve=partial(_stiffness, layers),
        x_unit="mm below the surface",
        unit="N mm / rad / mm",
    )


def _stiffness(layers: _Layers, stiffness: float, _: float, *c: float) -> Points:
    return layers.middles_mm, stiffness * np.array(layers.curve.factors(c))


def _apply_elastic(
    layers: _Layers, rig: RigParameters, stiffness: float, time_constant: float, *c: float
) -> RigParameters:
    elastic = replace(
        rig,
        tissue_stiffness_n_mm_per_rad_per_mm=stiffness,
        tissue_time_constant_s=time_constant,
    )
    along = AlongDepth(stiffness=layers.curve.factors(c), thickness_mm=layers.thickness_mm)
    return _with(elastic, along)


def _where(deepest_mm: float, starts: int) -> tuple[Parameter, Parameter]:
    """Depth and thickness of one layer, which are looked for anywhere, as often as there are starts."""
    depth = place_of("depth", deepest_mm, starts * _FROM)
    return depth, replace(depth, name="thickness", start=(_THICK * deepest_mm,) * len(depth.start))


def place_of(name: str, deepest_mm: float, shares: Sequence[float]) -> Parameter:
    """A place in the tissue, or on the inserted shaft, looked for from shares of the depth on."""
    return Parameter(
        name=name,
        unit="mm",
        low=1.0,
        high=deepest_mm,
        start=tuple(share * deepest_mm for share in shares),
        logarithmic=True,
        neutral=None,
    )


def _one_dry_layer(deepest_mm: float, ranges: LogRanges, *, shared: bool) -> Family:
    depth, thickness = _where(deepest_mm, 1)
    level = ranges.dry_level
    usual = level.start[0] / _THICK
    level = replace(level, high=level.high / _THICK, start=(usual,) * len(depth.start))
    how = ", shared with the axial motion" if shared else ""
    return Family(
        effect=Effect(
            name=f"dry friction over position, in one layer{how}",
            title=f"dry friction of one layer of tissue{how}",
            place=Place.INTERFACE,
            parameters=(depth, thickness, level),
            apply=partial(_apply_one_dry_layer, shared),
            differences=(1e-1, 1e-2),
        ),
        places=_FRICTION,
        says=SAYS,
        title=f"dry friction along the shaft{how}",
        curve=partial(box, 0.0),
        x_unit="mm below the surface",
        unit="N mm / mm",
    )


def _apply_one_dry_layer(
    shared: bool, rig: RigParameters, depth: float, thickness: float, level: float
) -> RigParameters:
    levels = (0.0, level, 0.0)
    dry = AlongDepth(friction_n_mm_per_mm=levels, shared=shared, thicknesses_mm=(depth, thickness))
    return _with(rig, dry)


def _one_layer(deepest_mm: float, ranges: LogRanges) -> Family:
    depth, thickness = _where(deepest_mm, len(_TIMES))
    factors = tuple(times for times in _TIMES for _ in _FROM)
    times = factor_of_damping(factors)
    return Family(
        effect=Effect(
            name="damping over position, in one layer",
            title="one layer of tissue whose damping is another",
            place=Place.TISSUE,
            parameters=(depth, thickness, times),
            apply=_apply_one_layer,
            differences=(1e-1, 1e-2),
        ),
        places=_EITHER,
        says=SAYS,
        title="damping along the shaft",
        curve=partial(_one_layers, ranges.damping_n_mm_s_per_mm),
        x_unit="mm below the surface",
        unit=VISCOUS,
    )


def _one_layers(beta: float, depth: float, thickness: float, times: float) -> Points:
    return box(beta, depth, thickness, beta * times)


def factor_of_damping(starts: tuple[float, ...]) -> Parameter:
    """Damping of a part of the tissue over that of the rest."""
    return Parameter(
        name="times", unit="-", low=0.02, high=50.0, start=starts, logarithmic=True, neutral=1.0
    )


def box(outside: float, depth: float, thickness: float, inside: float) -> Points:
    """A curve that is another from a place on, over a length."""
    above, below = depth, depth + thickness
    ends = (0.0, above, above + _STEP_MM, below, below + _STEP_MM, below + depth)
    return ends, (outside, outside, inside, inside, outside, outside)


def _apply_one_layer(rig: RigParameters, depth: float, thickness: float, times: float) -> RigParameters:
    return _with(rig, AlongDepth(damping=(1.0, times, 1.0), thicknesses_mm=(depth, thickness)))


def _with(rig: RigParameters, along: AlongDepth) -> RigParameters:
    return replace(rig, free=FreeLaw(along_depth=along))
