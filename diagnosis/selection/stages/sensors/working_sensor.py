"""What the drift of a working sensor may be, beside the best explanation of a search.

A drift of more than DRIFT_RANGE_SIGMA within a trial, or than DRIFT_QUICKEST_SIGMA within a second, is
none of a sensor that works; nor is one of more than DRIFT_ALIKE_SIGMA that is the same line in every
trial, or than DRIFT_ONE_COURSE_SIGMA that is another course, and the same in every trial. Where
nothing else is missing, a drift of the tip by more than DRIFT_OF_TIP_ALONE_SIGMA, over all trials, is
itself what the model lacks; and so is one of the torque whose zeros in the trials are further apart than
DRIFT_ALIKE_SIGMA and than all that it drifts by within them. And it stands beside one effect at most,
but for those of the other sensor: with two it takes the shape of what no library holds. Nor does it
follow the axial speed, the angle of the base (torque), or depth, rate, direction or angle of the tip
(scoring/followed); and where such a law is likelier than a drift, it is none.

Sigma is the noise of a reading as the sensor gives it: means and filters quieten it, and leave a drift.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm, ttest_1samp

from diagnosis.criteria.noise import DRIFT_START_SIGMA
from diagnosis.criteria.selection import (
    DRIFT_ALIKE_SIGMA,
    DRIFT_FOLLOWS_SIGMA,
    DRIFT_MOST_EFFECTS,
    DRIFT_OF_TIP_ALONE_SIGMA,
    DRIFT_ONE_COURSE_SIGMA,
    DRIFT_QUICKEST_SIGMA,
    DRIFT_RANGE_SIGMA,
)
from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Place
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.drift import (
    drift_in_a_second_sigma,
    drift_means_apart,
    drift_range_sigma,
    drift_ranges_sum,
    drift_spread_sigma,
    drifts_alike,
    drifts_along_lines,
    drifts_by_one_course,
    means_sigma,
    starts,
)
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.replay import replay
from diagnosis.selection.scoring.drift_evidence import noise_of_a_reading, score_beside_drift
from diagnosis.selection.scoring.followed import followed
from diagnosis.selection.stages.stage import leading_on_the_log
from diagnosis.selection.state import SearchState

OFFSETS: Mapping[str, str] = MappingProxyType({TORQUE: "torque_bias", TIP: "tip_angle_bias"})
_SEVERAL = 3  # trials, whose scatter tells whether their mean is by chance


def drifts(state: SearchState, sensor: str) -> bool:
    """Whether a drift of the sensor is allowed for."""
    return sensor in state.problem.noise.drifts


def with_few_effects(state: SearchState, sensor: str, beside: Sequence[str] = ()) -> SearchState:
    """The state without explanations that name more effects than may be beside a drift of a sensor.

    Effects of the readings of another sensor do not count: a drift of this one cannot take their shape.

    Args:
      beside: effects that do not count either.
    """
    elsewhere = {
        e.name for e in LIBRARY.values() if e.place is Place.SENSOR and e.needs not in ("", sensor)
    }
    counted = set(LIBRARY) - elsewhere - set(beside)
    few = (c for c in state.candidates if len(counted & {*c.names}) <= DRIFT_MOST_EFFECTS)
    return replace(state, candidates=tuple(few))


def range_sigma(state: SearchState, sensor: str) -> float:
    """Largest range of the drift beside the best within a trial, in sigma of a reading."""
    return _of_a_reading(state, sensor, drift_range_sigma)


def in_a_second_sigma(state: SearchState, sensor: str) -> float:
    """Largest change of the drift beside the best within a second, in sigma of a reading."""
    return _of_a_reading(state, sensor, drift_in_a_second_sigma)


def drifts_too_far(state: SearchState, sensor: str) -> str:
    """Why the drift beside the best is too large or quick for a working sensor; empty: it is not."""
    most, quickest = range_sigma(state, sensor), in_a_second_sigma(state, sensor)
    if most > allowed_sigma(state, sensor):
        return f"{most:.1f} sigma within a trial is more than a sensor's drift"
    if quickest > DRIFT_QUICKEST_SIGMA:
        return f"{quickest:.1f} sigma within a second is more than a sensor's drift"
    return ""


def spread_sigma(state: SearchState, sensor: str) -> float:
    """Range of that drift over all trials, in sigma of a reading."""
    return _of_a_reading(state, sensor, drift_spread_sigma)


def _of_a_reading(state: SearchState, sensor: str, size: Callable[..., float]) -> float:
    problem = state.problem
    sigma = size(problem.log, sensor, problem.noise, _replayed(state))
    return sigma * problem.noise[sensor] / noise_of_a_reading(problem, sensor)


def zeros_apart(state: SearchState, sensor: str) -> bool:
    """Whether trials have other zeros, further apart than the sensor drifts within all of them."""
    apart, within = (
        _of_a_reading(state, sensor, size) for size in (drift_means_apart, drift_ranges_sum)
    )
    return apart > max(within, DRIFT_ALIKE_SIGMA)


def allowed_sigma(state: SearchState, sensor: str) -> float:
    """Range of a drift of a working sensor; less, where it is the same in every trial."""
    of = state.problem.log, sensor, state.problem.noise, _replayed(state)
    if not (drifts_alike(*of) or drifts_by_one_course(*of)):
        return DRIFT_RANGE_SIGMA
    return DRIFT_ALIKE_SIGMA if drifts_along_lines(*of) else DRIFT_ONE_COURSE_SIGMA


def is_all_that_is_missing(state: SearchState, sensor: str) -> bool:
    """Whether the drift is too large for one beside which nothing but its offset is missing."""
    alone = {*state.best.named} <= {OFFSETS[sensor]}
    large = spread_sigma(state, sensor) > DRIFT_OF_TIP_ALONE_SIGMA
    return alone and (large if sensor == TIP else zeros_apart(state, sensor))


def what_it_follows(state: SearchState, sensor: str) -> str:
    """What the readings follow beside the best and its drift, in words; empty: nothing."""
    found = followed(state.problem, state.best.fit, sensor)
    most = max(found, key=lambda one: one.gain)
    return most.name if most.gain > DRIFT_FOLLOWS_SIGMA**2 else ""


def what_is_likelier(state: SearchState, drifting: SearchState, sensor: str) -> str:
    """What the readings rather follow than that they drift, in words; empty: nothing.

    Args:
      state: without drift.
      drifting: with it.
    """
    most = score_beside_drift(drifting.best, drifting.problem)
    for one in leading_on_the_log(state):
        for law in followed(state.problem, one.fit, sensor):
            allowed = law.parameters * math.log(one.fit.samples)
            if score_beside_drift(one, state.problem) - law.gain + allowed < most:
                return law.name
    return ""


def is_off_zero(state: SearchState, sensor: str) -> bool:
    """Whether the drift beside the best begins off zero, or is off it on average over its trials."""
    of = state.problem.log, sensor, state.problem.noise, _replayed(state)
    return _begin_off(starts(*of)) or _is_off(means_sigma(*of))


def begins_off_zero(state: SearchState, sensor: str) -> bool:
    """Whether the drift beside the best begins off zero in every trial, or on average.

    Of several trials to the same side in each: an offset would be the same in all.
    """
    return _begin_off(starts(state.problem.log, sensor, state.problem.noise, _replayed(state)))


def _begin_off(begun: NDArray[np.float64]) -> bool:
    to_a_side = begun.size < _SEVERAL or bool(np.ptp(np.sign(begun)) == 0)
    in_each = bool(begun.size) and to_a_side and bool(np.abs(begun).min() > DRIFT_START_SIGMA)
    return in_each or _is_off(begun)


def _is_off(values: NDArray[np.float64]) -> bool:
    """Whether several values are off zero on average."""
    by_chance = 2.0 * norm.sf(DRIFT_START_SIGMA)
    return values.size >= _SEVERAL and bool(ttest_1samp(values, 0.0).pvalue < by_chance)


def _replayed(state: SearchState) -> list[Prediction]:
    problem, fit = state.problem, state.best.fit
    return replay(problem.log, fit.parameterization.rig(fit.x), problem.resolution)
