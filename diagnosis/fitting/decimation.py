"""A log with fewer samples, on which a coarse needle gives the same results as a fine one.

The changes due to effects are slow compared with the samples. Samples are averaged over windows of
40 ms, and the influence of averaging and of the coarse needle on the nominal rig is removed:

    decimated = mean(measured - nominal, fine) + nominal, coarse

so that the residual of the nominal rig on the decimated log is the mean of that on the
log. Sums of squares / sigma^2 are preserved, at a tenth of the cost: a mean of few readings, of a sensor
that was read less often than others or lost some, counts for less. Where the coarse needle does not
follow the nominal rig, for its base turns fast or its noise is small, windows are shorter, by up to
half: what an effect changes would be as wrong. Of a long log they are up to twice as long where it
follows closely.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid

from diagnosis.criteria.replay import DECIMATION_SIGMA, LONG_LOG_S, WIDE_SIGMA
from diagnosis.fitting.problem import FitProblem
from diagnosis.log.trial import SENSORS
from diagnosis.prepare.noise.colour import Colour
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.prepare.prepared_log import PreparedLog, PreparedTrial
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.replay import predict
from diagnosis.replay.resolution import COARSE, Resolution
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters

Array = NDArray[np.float64]

_SAME_S = 1e-9
_WIDER, _NARROWER = (2.0, 1.5, 1.25), (0.75, 0.5)  # windows that are tried, over the usual ones
_TOLERANCE_SIGMA = 0.3  # of fits that only tell which ones to do again on the log itself


def decimated(
    problem: FitProblem, nominal: Sequence[Prediction], nominal_rig: RigParameters = NOMINAL
) -> FitProblem:
    """The problem for a coarse needle, given the fine nominal predictions of its trials.

    Args:
      nominal_rig: the rig of these predictions, with the pasts of trials that began late.

    Raises:
      SimulationFailed: the nominal rig cannot be simulated with the coarse needle.
    """
    for resolution, most_sigma in _tried(problem.log):
        rare, error_sigma = _decimated(problem, nominal, nominal_rig, resolution)
        if error_sigma <= most_sigma:
            break
    return rare


def _tried(log: PreparedLog) -> list[tuple[Resolution, float]]:
    """Resolutions, widest windows first, and up to which error of the coarse needle each is taken."""
    tried = [(COARSE, DECIMATION_SIGMA), *((_times(t), DECIMATION_SIGMA) for t in _NARROWER)]
    long = sum(float(np.ptp(trial.time_s)) for trial in log.trials) > LONG_LOG_S
    return [*((_times(t), WIDE_SIGMA) for t in _WIDER), *tried] if long else tried


def _times(factor: float) -> Resolution:
    return replace(COARSE, step_s=factor * COARSE.step_s)


def _decimated(
    problem: FitProblem,
    nominal: Sequence[Prediction],
    nominal_rig: RigParameters,
    resolution: Resolution,
) -> tuple[FitProblem, float]:
    """The problem in windows of one step, and the largest rms error of the coarse needle, in sigma."""
    log, step_s = problem.log, resolution.step_s
    bare = replace(log, trials=tuple(_without_readings(trial, step_s) for trial in log.trials))
    coarse = [predict(log.rig, trial, [nominal_rig], resolution)[0] for trial in bare.trials]
    each = list(zip(log.trials, nominal, bare.trials, coarse, strict=True))
    trials = tuple(_with_readings(*one, step_s, _share(log, bare)) for one in each)
    rare = PreparedLog(
        rig=log.rig,
        trials=trials,
        tissue_dragged=log.tissue_dragged,
        presliding_deg=log.presliding_deg,
    )
    noise = decimated_noise(problem.noise, log, rare)
    decimated = replace(
        problem,
        log=rare,
        noise=noise,
        resolution=resolution,
        tolerance_sigma=_TOLERANCE_SIGMA,
        callback_alone=True,
        differences_halved=True,
    )
    return decimated, max(_error_sigma(*one, step_s, noise) for one in each)


def _error_sigma(
    trial: PreparedTrial,
    nominal: Prediction,
    bare: PreparedTrial,
    coarse: Prediction,
    step_s: float,
    noise: Noise,
) -> float:
    """Rms by which the coarse nominal readings differ from means of the fine ones, in sigma."""
    off = [0.0]
    for sensor in (s for s in SENSORS if trial.has(s)):
        fine = _means(trial.time_s, nominal[sensor], bare.time_s, _window_s(trial, step_s))
        off.append(float(np.sqrt(np.nanmean((coarse[sensor] - fine) ** 2))) / noise[sensor])
    return max(off)


def decimated_noise(noise: Noise, log: PreparedLog, rare: PreparedLog) -> Noise:
    """Noise of the decimated log, with the same spectral density at frequency 0 as that of the log.

    The white part is reduced by averaging. Coloured parts keep their correlation times, with the
    variances for which the densities are preserved; an autoregression becomes that of means. Of an
    oscillation that is fast for the decimated log no more is left than its density, as white noise.
    """
    share = _share(log, rare)
    step_s = float(np.median([trial.sample_s for trial in rare.trials]))
    sigma, colour = dict(noise.sigma), dict[str, Colour]()
    for sensor, own in noise.colour.items():
        size, kept = own.of_means(share, step_s)
        sigma[sensor] *= size
        if kept:
            colour[sensor] = kept
    sigma = {sensor: s * float(np.sqrt(share)) for sensor, s in sigma.items()}
    return replace(noise, sigma=sigma, colour=colour)


def gap_on_the_log(gap: float, problem: FitProblem, coarse: FitProblem) -> float:
    """Gap that is about that on the decimated log, whose samples are means of several readings.

    Args:
      problem, coarse: the log itself, and decimated.
    """
    readings = problem.samples / max(coarse.samples, 1)
    return float(np.sqrt(1.0 + max(gap**2 - 1.0, 0.0) / readings))


def _share(log: PreparedLog, rare: PreparedLog) -> float:
    """Windows of a decimated log per sample of the log."""
    return sum(t.time_s.size for t in rare.trials) / sum(t.time_s.size for t in log.trials)


def _window_s(trial: PreparedTrial, step_s: float) -> float:
    return max(step_s, trial.sample_s)


def _without_readings(trial: PreparedTrial, step_s: float) -> PreparedTrial:
    """The inputs of a trial at the middles of windows of one step."""
    time_s, width_s = trial.time_s, _window_s(trial, step_s)
    middles_s = time_s[0] + width_s * np.arange(int((time_s[-1] - time_s[0]) / width_s) + 1)

    def sampled(values: Array) -> Array:
        return np.asarray(np.interp(middles_s, time_s, values))

    base = _means(time_s, trial.base_motion_deg, middles_s, width_s)
    torque = trial.tip_torque_n_mm
    return replace(
        trial,
        time_s=middles_s,
        base_motion_deg=np.where(np.isnan(base), sampled(trial.base_motion_deg), base),
        inserted_mm=sampled(trial.inserted_mm),
        free_mm=sampled(trial.free_mm),
        speed_mm_s=sampled(trial.speed_mm_s),
        tip_torque_n_mm=None if torque is None else sampled(torque),
        readings={},
        logged=np.zeros(middles_s.size, bool),
    )


def _with_readings(
    trial: PreparedTrial,
    nominal: Prediction,
    bare: PreparedTrial,
    coarse: Prediction,
    step_s: float,
    share: float,
) -> PreparedTrial:
    """The inputs with the means of readings, and the weights that these have in a log of that share."""
    width_s, readings, weights = _window_s(trial, step_s), {}, {}
    for sensor in SENSORS:
        if trial.has(sensor):
            residual = trial.readings[sensor] - nominal[sensor]
            readings[sensor] = _means(trial.time_s, residual, bare.time_s, width_s) + coarse[sensor]
            half_s = _half_widths_s(trial.time_s, bare.time_s, width_s)
            counts = _counts(trial.time_s[np.isfinite(residual)], bare.time_s, half_s)
            own = trial.weights.get(sensor, np.ones(trial.time_s.size))
            weights[sensor] = np.sqrt(share * counts) * np.interp(bare.time_s, trial.time_s, own)
    return replace(bare, readings=readings, weights=weights)


def _means(time_s: Array, values: Array, middles_s: Array, width_s: float) -> Array:
    """Means over windows about `middles_s`, (M,); NaN where a window holds hardly a sample."""
    fine = np.isfinite(values)
    known, at = values[fine], time_s[fine]
    if known.size < 2:
        return np.full(middles_s.shape, np.nan)
    half = _half_widths_s(time_s, middles_s, width_s)
    # Where readings begin or end within a window, the mean is that of what was read.
    last, first = (np.clip(middles_s + side * half, at[0], at[-1]) for side in (1, -1))
    covered = last - first
    every = np.unique(np.concatenate([at, first, last]))
    area = np.asarray(cumulative_trapezoid(np.interp(every, at, known), every, initial=0), float)
    means = np.interp(last, every, area) - np.interp(first, every, area)
    narrow = covered < _SAME_S
    means = np.where(narrow, np.interp(middles_s, at, known), means / np.where(narrow, 1.0, covered))
    return np.where(_sparse(at, middles_s, half), np.nan, means)


def _half_widths_s(time_s: Array, middles_s: Array, width_s: float) -> Array:
    """Half of the width of every window, which ends with the trial on both sides alike, (M,)."""
    inside_s = np.minimum(middles_s - time_s[0], time_s[-1] - middles_s)
    return np.asarray(np.minimum(0.5 * width_s, inside_s))


def _counts(read_s: Array, middles_s: Array, half_s: Array) -> Array:
    """Number of readings in every window, (M,); half of one at its border, which is in two of them."""
    first, last = (middles_s + side * half_s for side in (-1, 1))
    sides = [
        np.searchsorted(read_s, last + near) - np.searchsorted(read_s, first + near)
        for near in (-_SAME_S, _SAME_S)
    ]
    return np.where(half_s > _SAME_S, np.mean(sides, axis=0), 1.0)


def _sparse(at_s: Array, middles_s: Array, half_s: Array) -> NDArray[np.bool_]:
    """Mask of windows with fewer than half of the usual number of samples."""
    reach = half_s + _SAME_S
    count = np.searchsorted(at_s, middles_s + reach, "right") - np.searchsorted(at_s, middles_s - reach)
    usual = float(np.median(count[count > 0])) if count.any() else 1.0
    few = (count < 0.5 * usual) & (half_s > _SAME_S)
    outside = (middles_s + reach < at_s[0]) | (middles_s - reach > at_s[-1])
    return np.asarray(few | outside)
