"""Logs whose noise is not of one size, and what every stage that allows for such noise has to do."""

from dataclasses import replace

import numpy as np
from diagnosis_fixtures import TIP, joined, log_of, start_of_search, turns

from diagnosis.log.trial import Trial
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.stages.nominal_rig import nominal_rig
from diagnosis.workers import Workers

SENSOR = "tip_angle_deg"
MORE = (0.0, 0.0, 0.0, 6.0)  # noise that is added to the tip in each trial, in its own


def four_trials():
    """Of the nominal rig."""
    return joined(*(log_of(NOMINAL, seed=seed, angle=turns(12.0)) for seed in range(len(MORE))))


def noisy(log, seed=6):
    """The log, with more noise of the tip in the last trial."""
    rng = np.random.default_rng(seed)
    trials = []
    for one, more in zip(log.trials, MORE, strict=True):
        tip = one[SENSOR] + TIP * more * rng.normal(size=len(one.table))
        trials.append(Trial(name=one.name, table=one.table.assign(tip_angle_deg=tip)))
    return replace(log, trials=tuple(trials))


def searched(log, stage):
    """The states before and after a stage."""
    state = nominal_rig(start_of_search(log, effects=()), Workers())
    return state, stage(state, Workers())


def check_it_is_allowed_for_and_told(before, after, stage, words):
    """Nothing explained the log before; with the stage the nominal rig does, and a note says why."""
    _, explained = before.rechecked()
    assert not explained
    _, explained = after.rechecked()
    assert explained
    assert [e.stage for e in after.record[len(before.record) :] if e.score is None] == [stage]
    (note,) = [n for n in after.problem.noise.notes if words in n]
    assert note.startswith(SENSOR)


def check_it_is_left_alone(before, after):
    """Of a log that is explained."""
    assert after.problem is before.problem
    assert after.problem.noise.varies == {}
