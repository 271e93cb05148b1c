"""Small logs of our own needle, one sensor of which drifts."""

import numpy as np
from diagnosis_fixtures import RIG, joined, log_of, log_with, prepared, start_of_search, trial, turns

from diagnosis.log.trial import TIP, TORQUE, Trial
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.stages.nominal_rig import nominal_rig
from diagnosis.selection.stages.sensors.sensor_drift import (
    drift_of_the_tip_sensor,
    drift_of_the_torque_sensor,
)
from diagnosis.workers import Workers

STAGES = {TORQUE: drift_of_the_torque_sensor, TIP: drift_of_the_tip_sensor}
SIZES = {TORQUE: 0.015, TIP: 0.375}
"""What a size of 1 is in these logs: 1.5 times the noise of a reading."""


def off(log, sensor, course):
    """The log with a reading of its one trial off by a course over the share of its time, in sizes."""
    (one,) = log.trials
    share = (one.table["time_s"] / one.table["time_s"].iloc[-1]).to_numpy()
    moved = one.table[sensor] + SIZES[sensor] * course(share)
    return log_with(Trial(name=one.name, table=one.table.assign(**{sensor: moved})))


def drifted(size, sensor=TORQUE):
    """A nominal rig, a sensor of which drifts by a line of that size."""
    return off(log_of(NOMINAL, seconds=14.0), sensor, lambda share: size * share)


def jumped(size, sensor=TORQUE):
    """The same with a sensor that jumps in the middle, and stays off."""
    return off(log_of(NOMINAL, seconds=14.0), sensor, lambda share: size * (share >= 0.5))


def sliding():
    """A nominal rig whose needle slides to and fro by 1 mm/s while its base turns."""
    rng, clean = np.random.default_rng(0), trial(turns(14.0))
    speed = np.sign(np.sin(1.5 * clean.table["time_s"]))
    moved = clean.table.assign(speed_mm_s=speed, free_mm=60.0 - 0.01 * np.cumsum(speed))
    found = predict(RIG, prepared(Trial(name=clean.name, table=moved)), [NOMINAL])[0]
    read = {s: found[s] + rng.normal(0.0, SIZES[s] / 1.5, len(moved)) for s in SIZES}
    return log_with(Trial(name=clean.name, table=moved.assign(**read)))


def searched(log, sensor=TORQUE):
    """The nominal rig alone, then with drift if that is needed."""
    state = nominal_rig(start_of_search(log, effects=()), Workers())
    return state, STAGES[sensor](state, Workers())


def moved(*each, sensor=TORQUE):
    """Nominal rigs, a sensor of each off by an offset and a line between two values, in sigma."""
    trials = []
    for offset, first, last in each:
        log = log_of(NOMINAL, seconds=10.0, seed=len(trials))
        ends = np.array([offset + first, offset + last]) / 1.5
        (one,) = off(log, sensor, lambda share, ends=ends: np.interp(share, [0, 1], ends)).trials
        trials.append(Trial(name=f"trial_{len(trials) + 1:02d}.csv", table=one.table))
    return log_with(*trials)


def settling(trials, sensor):
    """Nominal rigs; a sensor of each goes from zero to 1.3 sizes in a fifth of a trial, and stays."""
    each = [
        off(
            log_of(NOMINAL, seconds=8.0, seed=seed),
            sensor,
            lambda share, rate=8.0 + 2.0 * seed: 1.3 * (1.0 - np.exp(-rate * share)),
        )
        for seed in range(trials)
    ]
    return joined(*each)
