"""What the nearest explanation predicts and leaves, on a log whose effect is known."""

import numpy as np
from diagnosis_fixtures import log_of

from diagnosis.assessment.replayed import Replayed
from diagnosis.fitting.fit import fit_effects
from diagnosis.log.trial import SENSORS
from diagnosis.nominal_replay import replay_nominal
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.selection.candidate import candidate

DRY = RigParameters(kinetic_n_mm_per_mm=0.001)


def test_an_explanation_predicts_at_the_samples_and_leaves_less_than_the_nominal_rig():
    log = log_of(DRY, seconds=6.0)
    nominal = replay_nominal(log)
    near = candidate(fit_effects(nominal.problem, ("coulomb_friction",)))
    read = Replayed.of(log, nominal.problem, nominal.predictions, near)
    assert read.rig != NOMINAL
    for explained, trial in zip(read.explained, log.trials, strict=True):
        assert all(explained[s].shape == trial[s].shape for s in SENSORS if trial.has(s))
    before, left = (rms(residuals) for residuals in (read.before, read.left))
    assert left < 1.1  # the noise, in units of sigma
    assert before > 2 * left


def rms(residuals):
    every = np.concatenate([own for one in residuals for own in one.left.values()])
    return np.sqrt(np.nanmean(every**2))
