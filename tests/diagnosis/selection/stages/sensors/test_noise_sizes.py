"""The state of a search in which trials have noise of their own size."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import joined, log_of, start_of_search, turns

from diagnosis.log.trial import Trial
from diagnosis.prepare.noise.noise_of_trials import NoiseOfTrials
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.record import Decision
from diagnosis.selection.stages.nominal_rig import nominal_rig
from diagnosis.selection.stages.sensors.noise_sizes import fitted_with_sizes, left_at_samples
from diagnosis.workers import Workers

SENSOR = "tip_angle_deg"
RATIOS = {"trial_01.csv": 0.8, "trial_02.csv": 1.25}
RATIO = 1.1
UNREAD = slice(100, 130)


@pytest.fixture(scope="module")
def before():
    """Two trials, of the first of which some readings of the tip are missing."""
    first, other = (log_of(NOMINAL, seed=seed, angle=turns(8.0)) for seed in (1, 2))
    (one,) = first.trials
    tip = one[SENSOR].copy()
    tip[UNREAD] = np.nan
    first = replace(first, trials=(Trial(name=one.name, table=one.table.assign(tip_angle_deg=tip)),))
    return nominal_rig(start_of_search(joined(first, other), effects=()), Workers())


def test_what_is_left_stands_at_its_sample(before):
    left = left_at_samples(before.problem, before.nominal)
    (first, values), (_, others) = left[SENSOR]
    assert values.shape == first.time_s.shape
    assert np.isnan(values[UNREAD]).all()
    assert np.count_nonzero(np.isnan(values)) == UNREAD.stop - UNREAD.start
    rows = before.nominal.by_trial[1]
    assert np.isin(others, rows).all()


def test_what_was_fitted_is_in_units_of_the_noise_of_each_sample(before):
    own = NoiseOfTrials(ratios=RATIOS, noise_ratio=RATIO)
    after = fitted_with_sizes("a stage", before, {SENSOR: own}, Workers())
    parts = zip(
        left_at_samples(before.problem, before.nominal)[SENSOR],
        left_at_samples(after.problem, after.nominal)[SENSOR],
        strict=True,
    )
    for (trial, old), (_, new) in parts:
        np.testing.assert_allclose(new, old / (RATIO * RATIOS[trial.name]), rtol=1e-12)
    told = [e for e in after.record if e.stage == "a stage" and e.decision is Decision.KEPT]
    assert [e.reason for e in told] == [f"{SENSOR}: it {own.in_words}"]
    assert any(e.stage == "a stage" and e.decision is Decision.MADE for e in after.record)


def test_the_other_sensor_is_as_before(before):
    own = NoiseOfTrials(ratios=RATIOS, noise_ratio=RATIO)
    after = fitted_with_sizes("a stage", before, {SENSOR: own}, Workers())
    other = "base_torque_n_mm"
    parts = zip(
        left_at_samples(before.problem, before.nominal)[other],
        left_at_samples(after.problem, after.nominal)[other],
        strict=True,
    )
    for (_, old), (_, new) in parts:
        np.testing.assert_array_equal(new, old)
