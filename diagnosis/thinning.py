"""A log with fewer samples, on which a coarse needle answers as a fine one does.

What effects do is slow beside the samples. Samples are averaged over windows of
40 ms, and what the averaging and the coarse needle do to the nominal rig is taken off:

    thinned = mean(measured - nominal, fine) + nominal, coarse

so that the nominal rig misses the thinned log by the mean of what it misses the
log by. Sums of squares over the noise are kept, at a tenth of the cost.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid

from diagnosis.evidence import COARSE, Evidence
from diagnosis.noise import Noise
from diagnosis.predict import Prediction, predict
from diagnosis.rig_log import SENSORS, RigLog, Trial
from diagnosis.rig_model import RigModel

Array = NDArray[np.float64]


def thinned(evidence: Evidence, nominal: Sequence[Prediction]) -> Evidence:
    """The evidence for a coarse needle, given the fine nominal predictions of its trials."""
    log = evidence.log
    each = zip(log.trials, nominal, strict=True)
    trials = tuple(_thin(log, trial, prediction) for trial, prediction in each)
    samples = sum(trial.table.shape[0] for trial in log.trials)
    windows = sum(trial.table.shape[0] for trial in trials)
    sigma = {sensor: s * np.sqrt(windows / samples) for sensor, s in evidence.noise.sigma.items()}
    return Evidence(
        log=replace(log, trials=trials),
        noise=Noise(sigma=sigma, warnings=evidence.noise.warnings),
        nuisance=evidence.nuisance,
        resolution=COARSE,
    )


def _thin(log: RigLog, trial: Trial, nominal: Prediction) -> Trial:
    time = trial["time_s"]
    width = max(COARSE.step_s, float(np.median(np.diff(time))))
    middles = time[0] + width * np.arange(int((time[-1] - time[0]) / width) + 1)
    columns = {c: np.interp(middles, time, trial[c]) for c in trial.table.columns if c not in SENSORS}
    base = _means(time, trial["base_angle_deg"], middles, width)
    base = np.where(np.isnan(base), columns["base_angle_deg"], base)
    columns |= {"time_s": middles, "base_angle_deg": base}
    bare = Trial(name=trial.name, table=pd.DataFrame(columns))
    coarse = predict(log.rig, bare, [RigModel()], COARSE)[0]
    for sensor in SENSORS:
        if trial.has(sensor):
            missed = _means(time, trial[sensor] - nominal[sensor], middles, width)
            columns[sensor] = missed + coarse[sensor]
    return Trial(name=trial.name, table=pd.DataFrame(columns))


def _means(time: Array, values: Array, middles: Array, width: float) -> Array:
    """Means over windows about `middles`, (M,); NaN where a window holds hardly a sample."""
    fine = np.isfinite(values)
    known, at = values[fine], time[fine]
    if known.size < 2:
        return np.full(middles.shape, np.nan)
    half = np.minimum(0.5 * width, np.minimum(middles - time[0], time[-1] - middles))
    area = np.asarray(cumulative_trapezoid(known, at, initial=0), float)
    means = np.interp(middles + half, at, area) - np.interp(middles - half, at, area)
    narrow = half < 1e-9
    means = np.where(narrow, np.interp(middles, at, known), means / np.where(narrow, 1.0, 2 * half))
    return np.where(_sparse(at, middles, half), np.nan, means)


def _sparse(at: Array, middles: Array, half: Array) -> NDArray[np.bool_]:
    """Windows with fewer than half of the usual number of samples."""
    reach = half + 1e-9
    count = np.searchsorted(at, middles + reach, "right") - np.searchsorted(at, middles - reach)
    return np.asarray((count < 0.5 * np.median(count)) & (half > 1e-9))
