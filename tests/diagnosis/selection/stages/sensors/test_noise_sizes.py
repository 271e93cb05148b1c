"""The state of a search in which the noise of a sensor is not of one size."""

from dataclasses import replace

import numpy as np
import pytest
from varying_logs import MORE, SENSOR, four_trials, noisy, searched

from diagnosis.log.trial import SENSORS, TORQUE, Trial
from diagnosis.prepare.noise.noise_of_trials import NoiseOfTrials
from diagnosis.selection.record import Decision
from diagnosis.selection.stages.sensors.noise_sizes import with_varying_noise

STAGE = "a stage"
OWN = NoiseOfTrials(
    ratios={f"trial_{i + 1:02d}.csv": 0.8 + 0.2 * i for i in range(len(MORE))}, noise_ratio=1.1
)
UNREAD = slice(100, 130)


@pytest.fixture(scope="module")
def found():
    """Before, after, and what was asked of each sensor; some readings of the tip are missing."""
    log, asked = noisy(four_trials()), {}
    first, *others = log.trials
    tip = first[SENSOR].copy()
    tip[UNREAD] = np.nan
    first = Trial(name=first.name, table=first.table.assign(tip_angle_deg=tip))

    def find(_problem, sensor, left):
        asked[sensor] = left
        return OWN if sensor == SENSOR else None

    log = replace(log, trials=(first, *others))
    return *searched(log, lambda state, workers: with_varying_noise(STAGE, state, find, workers)), asked


def of_sensor(fit, problem, sensor):
    """Residuals of a fit by trial, (n,) each: those of the tip come first, then those of the torque."""
    read = [[int(np.isfinite(t.readings[s]).sum()) for s in SENSORS] for t in problem.log.trials]
    at = [*SENSORS].index(sensor)
    return [
        np.split(rows, np.cumsum(sizes)[:-1])[at] for rows, sizes in zip(fit.by_trial, read, strict=True)
    ]


def test_what_the_best_leaves_stands_at_its_sample(found):
    before, _, asked = found
    (first, values), *_ = asked[SENSOR]
    assert values.shape == first.time_s.shape
    np.testing.assert_array_equal(np.flatnonzero(np.isnan(values)), np.arange(1200)[UNREAD])
    rows = of_sensor(before.best.fit, before.problem, SENSOR)[0]
    np.testing.assert_array_equal(values[np.isfinite(values)], rows)
    assert asked.keys() == {*SENSORS}


def test_what_was_fitted_is_in_units_of_the_noise_of_each_sample(found):
    before, after, _ = found
    each = zip(
        before.problem.log.trials,
        of_sensor(before.nominal, before.problem, SENSOR),
        of_sensor(after.nominal, after.problem, SENSOR),
        strict=True,
    )
    for trial, old, new in each:
        np.testing.assert_allclose(new, old / (OWN.noise_ratio * OWN.ratios[trial.name]), rtol=1e-12)


def test_a_sensor_of_which_nothing_was_found_is_as_before(found):
    before, after, _ = found
    old, new = (of_sensor(s.nominal, s.problem, TORQUE) for s in (before, after))
    for one, other in zip(old, new, strict=True):
        np.testing.assert_array_equal(one, other)


def test_it_is_noted_and_the_leading_are_fitted_again(found):
    _, after, _ = found
    told = [e for e in after.record if e.stage == STAGE and e.decision is Decision.KEPT]
    assert [e.reason for e in told] == [f"{SENSOR}: it {OWN.in_words}"]
    assert any(e.stage == STAGE and e.decision is Decision.MADE for e in after.record)


def test_a_log_that_is_explained_is_not_asked():
    def find(*_):
        raise AssertionError

    before, after = searched(
        four_trials(), lambda state, workers: with_varying_noise(STAGE, state, find, workers)
    )
    assert after.problem is before.problem
