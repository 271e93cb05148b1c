"""Noise re-estimated from the residual of the best explanation.

Fourth differences give the noise whatever the nominal model lacks, but with low efficiency: to 2 %
from some thousands of samples. The residual of a good explanation is white, and its first differences
give the noise to 1 %. They are used if they are within 8 % of the first estimate: otherwise
something fast is left in them. The first estimate is that of the core of the noise: where its tails are
heavy, it may be larger by what they add. Of smoothed readings rare rows count, whose fourth differences
have the motion in them: there any less is believed, since nothing that a model lacks makes differences
smaller. And so much more as the noise before smoothing was more than after it, which is what a lab may
claim: what is fast in the residual shows as what is not white.

Whether the noise is white at all is tested on the residual of a fitted effect, and again on that of
the best explanation: the residual of the nominal rig contains too much else
(`prepare/noise/spectrum`). Differences of whitened residuals give the size of coloured noise as those of
residuals do for white noise.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.fitting import (
    NOISE_HEAVIEST,
    NOISE_HEAVY,
    NOISE_LEAST_ROWS,
    NOISE_LEAST_WEIGHT,
    NOISE_TRUST,
    SLOW_BLOCK,
)
from diagnosis.criteria.noise import COLOUR_MOST_PARTS, COLOUR_PARTS_GAP, COLOURED_BLOCK_S
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.noise_floor import NoiseFloor, floor_of
from diagnosis.fitting.problem import FitProblem
from diagnosis.log.faults.outlying import without_few
from diagnosis.log.trial import SENSORS
from diagnosis.log.white_noise import heaviness, white_noise
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.prepare.noise.spectrum.flicker import Flicker, flicker_noise
from diagnosis.prepare.prepared_log import PreparedTrial

Array = NDArray[np.float64]
Read = tuple[str, Array, Array]  # of a trial: sensor, times, s, (N,), residuals, (N,) or (N, n)


def with_colour(problem: FitProblem, best: Fit) -> Noise:
    """Noise of the sensors, with the colour that the residual of a fit shows.

    Of several parts where it is little more than noise: what a model lacks of a rig that swings is none.
    """
    plain, left = problem.noise.uncoloured, _in_units_of_sensors(problem, best)
    claims = problem.log.rig.sensors.by_column()  # a filter hides most of what differences show
    gaps = {
        s: floor_of([v[np.isfinite(v)] for _, v in parts]).gap / max(plain[s], claims[s])
        for s, parts in left.items()
    }
    few = {s: COLOUR_MOST_PARTS if gap <= COLOUR_PARTS_GAP else 1 for s, gap in gaps.items()}
    return problem.noise.with_colour(left, most_parts=few)


def flicker_left(problem: FitProblem, best: Fit, above_hz: float) -> dict[str, Flicker]:
    """Flicker noise in what a fit leaves, by sensor, for those that show any.

    Args:
      above_hz: frequency above which it is looked at.
    """
    left = _in_units_of_sensors(problem, best)
    each = {s: flicker_noise(parts, problem.noise.means_of, above_hz) for s, parts in left.items()}
    return {s: own for s, own in each.items() if own}


def _in_units_of_sensors(problem: FitProblem, best: Fit) -> dict[str, list[tuple[Array, Array]]]:
    """Times and what a fit leaves, by sensor and trial; a few outliers have no colour, and are NaN."""
    plain = problem.noise.uncoloured
    in_sigma = _of_exact_predictions(problem, in_units_of(problem, best.by_trial, plain))
    return {s: [(t, plain[s] * without_few(left)) for t, left in own] for s, own in in_sigma.items()}


def reestimated_noise(problem: FitProblem, best: Fit) -> Noise:
    """Noise of the sensors, from the residual of the best fit."""
    first = with_colour(problem, best) if problem.noise.colour else problem.noise
    left = _of_exact_predictions(problem, in_units_of(problem, best.by_trial, first))
    rare = _more_before_smoothing(problem)
    change = {s: _change([v for _, v in own], rare.get(s)) for s, own in left.items()}
    sigma = {s: max(own * change.get(s, 1.0), first.least.get(s, 0.0)) for s, own in first.sigma.items()}
    return replace(first, sigma=sigma)


def _of_exact_predictions(
    problem: FitProblem, by_trial: Sequence[Array]
) -> dict[str, list[tuple[Array, Array]]]:
    """Times and residuals by sensor and trial, NaN where readings count less; there they are no noise.

    All of them where too few count in full.
    """
    found = by_sensor(problem, by_trial)
    if not any(trial.weights for trial in problem.log.trials):
        return found
    for sensor, parts in found.items():
        kept = [_counts_in_full(t, sensor, problem.noise) for t in problem.log.trials if t.has(sensor)]
        if sum(own.sum() for own in kept) >= NOISE_LEAST_ROWS:
            found[sensor] = [
                (t, np.where(own, r, np.nan)) for (t, r), own in zip(parts, kept, strict=True)
            ]
    return found


def _counts_in_full(trial: PreparedTrial, sensor: str, noise: Noise) -> NDArray[np.bool_]:
    """Which readings of a sensor have the weight of their own noise, (n,)."""
    weights = trial.weights.get(sensor, 1.0) * noise.sizes(sensor, trial)
    return np.asarray(weights[np.isfinite(trial.readings[sensor])] > NOISE_LEAST_WEIGHT)


def slow_where_coloured(problem: FitProblem, by_trial: Sequence[Array]) -> dict[str, NoiseFloor]:
    """Noise floors of sensors with coloured noise, with blocks of seconds for the slow part."""
    step_s = float(np.median([trial.sample_s for trial in problem.log.trials]))
    block = max(round(COLOURED_BLOCK_S / step_s), SLOW_BLOCK)
    left = by_sensor(problem, by_trial)
    return {s: floor_of([r for _, r in left[s]], block) for s in problem.noise.colour}


def rescaled(fit: Fit, problem: FitProblem, noise: Noise) -> Fit:
    """A fit of the problem with its residuals, slopes and cost in units of another noise."""
    by_trial = in_units_of(problem, fit.by_trial, noise)
    return replace(
        fit,
        by_trial=by_trial,
        jacobian=in_units_of(problem, fit.jacobian, noise),
        cost=sum(float(r @ r) for r in by_trial) + fit.prior,
    )


def in_units_of(problem: FitProblem, by_trial: Sequence[Array], noise: Noise) -> tuple[Array, ...]:
    """Residuals of the problem, or their slopes, in units of another noise, whitened as it asks."""
    before = problem.noise
    found = []
    for rows, parts in zip(by_trial, by_trial_and_sensor(problem, by_trial), strict=True):
        each = [_other_units(part, before, noise) for part in parts]
        found.append(np.concatenate(each) if each else rows)  # a trial that is not read has no rows
    return tuple(found)


def _other_units(part: Read, before: Noise, noise: Noise) -> Array:
    sensor, time_s, values = part
    smaller = before[sensor] / noise[sensor]
    if before.alike(noise, sensor):
        return values * smaller
    return noise.whitened(sensor, time_s, smaller * before.restored(sensor, time_s, values))


def _more_before_smoothing(problem: FitProblem) -> dict[str, float]:
    """Noise before readings were smoothed over that after it, by sensor: of white noise only that
    below the corner passes.
    """
    corners = [(t, s, hz) for t in problem.log.trials for s, hz in t.smoothed_above_hz.items()]
    return {s: 1.0 / math.sqrt(min(2.0 * hz * trial.sample_s, 1.0)) for trial, s, hz in corners}


def _change(parts: Sequence[Array], rare: float | None) -> float:
    """Noise / its first estimate, from residuals in units of that estimate.

    Args:
      rare: by which the claim may be too small, where rows are rare; None: they are not.
    """
    found, heavy = white_noise(parts, order=1), heaviness(parts)
    tails = min(heavy, NOISE_HEAVIEST) if heavy > NOISE_HEAVY else 1.0
    trusted = (1 - NOISE_TRUST if rare is None else 0.0, (1 + NOISE_TRUST) * max(tails, rare or 1.0))
    return float(np.clip(found if np.isfinite(found) else 1.0, *trusted))


def by_trial_and_sensor(problem: FitProblem, by_trial: Sequence[Array]) -> list[list[Read]]:
    """Rows of residuals or slopes by trial and sensor, with the times of their samples."""
    found = []
    for trial, rows in zip(problem.log.trials, by_trial, strict=True):
        times = {s: trial.time_s[np.isfinite(trial.readings[s])] for s in SENSORS if trial.has(s)}
        ends = np.cumsum([time.size for time in times.values()])
        parts = np.split(rows, ends[:-1]) if times else []
        found.append([(s, time, part) for (s, time), part in zip(times.items(), parts, strict=True)])
    return found


def by_sensor(problem: FitProblem, by_trial: Sequence[Array]) -> dict[str, list[tuple[Array, Array]]]:
    """Times and residuals of every trial, by sensor."""
    found: dict[str, list[tuple[Array, Array]]] = {}
    for parts in by_trial_and_sensor(problem, by_trial):
        for sensor, time_s, values in parts:
            found.setdefault(sensor, []).append((time_s, values))
    return found
