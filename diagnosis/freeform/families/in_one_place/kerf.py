"""Free laws of a tip that is held by the kerf which it has cut, and cuts another as the needle moves on.

The laws are those of `models.kerf`: a spring that softens, of a bevel, or a sine, of a bent tip. Either
follows the tip while the needle slides.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.in_one_place.tip import AT_TIP_MM
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from models.kerf import Kerf

_ANGLES_DEG, _TRAVELS_MM = (5.0, 30.0, 5.0, 30.0), (3.0, 3.0, 20.0, 20.0)  # to start with
_ONE_KERF_MM = 1e6  # no needle cuts another
_SHOWN = np.linspace(0.0, 4.0, 17)  # times the angle beyond which the torque is level
_SHOWN_DEG = np.linspace(0.0, 180.0, 37)


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The laws, if the base turns; of a kerf that stays as it is, if the needle never slides."""
    if Variable.BASE_ANGLE not in ranges.ends:
        return ()
    return (_bevel(ranges), _bent_tip(ranges))


def _bevel(ranges: LogRanges) -> Family:
    angle = _logarithmic("angle", "deg", (0.5, 720.0), _ANGLES_DEG)
    effect = Effect(
        name="tip torque over tip_angle, from its kerf",
        title="bevel that is held by the kerf which it has cut",
        place=Place.NEEDLE,
        parameters=(_torque(ranges), angle, *_follows(ranges)),
        apply=_apply_bevel,
    )
    return _family(effect, _torques_of_bevel)


def _bent_tip(ranges: LogRanges) -> Family:
    effect = Effect(
        name="tip torque over tip_angle, from its tract",
        title="bent tip that is held by the tract which it has cut",
        place=Place.NEEDLE,
        parameters=(_torque(ranges), *_follows(ranges)),
        apply=_apply_bent_tip,
    )
    return _family(effect, _torques_of_bent_tip)


def _family(effect: Effect, torques: Callable[..., Points]) -> Family:
    return Family(
        effect=effect,
        places={Place.NEEDLE: 0.7, Place.TISSUE: 0.3},
        says="tip_angle",
        title="torque at the tip",
        curve=torques,
        x_unit="deg from its kerf",
        unit="N mm",
    )


def _torque(ranges: LogRanges) -> Parameter:
    """In the range of what `AT_TIP_MM` of shaft have of dry friction."""
    dry = ranges.dry_level
    return replace(
        dry,
        name="torque",
        unit="N mm",
        low=AT_TIP_MM * dry.low,
        high=AT_TIP_MM * dry.high,
        start=(AT_TIP_MM * dry.start[-1],) * len(_ANGLES_DEG),
    )


def _follows(ranges: LogRanges) -> tuple[Parameter, ...]:
    """How the kerf follows the tip, where the needle slides."""
    if Variable.AXIAL_SPEED not in ranges.ends:
        return ()
    start = (0.5,) * len(_TRAVELS_MM)
    back = Parameter(name="backwards", unit="-", low=0.0, high=1.0, start=start, neutral=None)
    return (_logarithmic("travel", "mm", (0.1, 1e3), _TRAVELS_MM), back)


def _logarithmic(name: str, unit: str, ends: tuple[float, float], start: tuple[float, ...]) -> Parameter:
    low, high = ends
    return Parameter(
        name=name, unit=unit, low=low, high=high, start=start, logarithmic=True, neutral=None
    )


def _torques_of_bevel(most_n_mm: float, angle_deg: float, *_: float) -> Points:
    return angle_deg * _SHOWN, most_n_mm * np.tanh(_SHOWN)


def _torques_of_bent_tip(most_n_mm: float, *_: float) -> Points:
    return _SHOWN_DEG, most_n_mm * np.sin(np.radians(_SHOWN_DEG))


def _apply_bevel(
    rig: RigParameters,
    most_n_mm: float,
    angle_deg: float,
    travel_mm: float = _ONE_KERF_MM,
    backwards: float = 1.0,
) -> RigParameters:
    kerf = Kerf(torque_n_mm=most_n_mm, angle_deg=angle_deg, travel_mm=travel_mm, backwards=backwards)
    return replace(rig, free=FreeLaw(kerfs=(kerf,)))


def _apply_bent_tip(
    rig: RigParameters, most_n_mm: float, travel_mm: float = _ONE_KERF_MM, backwards: float = 1.0
) -> RigParameters:
    kerf = Kerf(torque_n_mm=most_n_mm, travel_mm=travel_mm, backwards=backwards)
    return replace(rig, free=FreeLaw(kerfs=(kerf,)))
