"""An assessment whose explanation is a free-form law."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import TORQUE, log_of, problem_of
from free_forms import linear_fit, missing_with, nothing_told

from diagnosis.assessment.sensor_errors import SensorErrors
from diagnosis.criteria.freeform import CLOSED_GAP
from diagnosis.freeform.explained import explained_by
from diagnosis.freeform.families.readings import families
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.ranges import ranges_of
from diagnosis.log.trial import SENSORS
from diagnosis.replay.replay import replay
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.replay.twist import shaft_twist

RISE = 0.1  # of the torque reading within the trial, N mm: 10 sigma


CLOCK_ERRORS = SensorErrors(
    imperfections={"torque_clock": {}}, clock_starts=(), reading_jumps=(), drift_sigma={}
)
"""Of the nearest explanation."""


@pytest.fixture(scope="module")
def made():
    """A torque sensor that drifts, a straight drift fitted to it, and what is told without that."""
    size = 400
    clean = log_of(NOMINAL, seconds=4.0)
    table = clean.trials[0].table
    drift = np.linspace(0.0, RISE, size)
    table = table.assign(base_torque_n_mm=table["base_torque_n_mm"] + drift)
    log = replace(clean, trials=(replace(clean.trials[0], table=table),))
    problem = problem_of(
        log, sigma={"tip_angle_deg": 0.25, "base_torque_n_mm": TORQUE, "base_angle_deg": 0.02}
    )
    nominal = replay(problem.log)
    ranges = ranges_of(problem, nominal)
    family = next(f for f in families(ranges) if f.name == "torque reading over time")
    low, high = ranges.ends["time"]
    mean, slope = (RISE * x / 4.0 / ranges.missing["base_torque_n_mm"] for x in (high + low, high - low))
    size = len(family.effect.parameters)
    x = [0.5 * mean, 0.5 * slope, *[0.0] * (size - 2)]
    rig = family.effect.apply(NOMINAL, *(v * ranges.missing["base_torque_n_mm"] for v in x))
    left = problem.residuals([rig])[0][0]
    fit = replace(
        linear_fit(family, [np.zeros((left.size, size))], [np.zeros(left.size)], x=x), by_trial=(left,)
    )
    best = FreeFit(family=family, fit=fit, gap_after=1.0, final=True)
    before = nothing_told(next_experiment="look closer", sensors=CLOCK_ERRORS)
    return log, problem, nominal, best, before


@pytest.fixture(scope="module")
def told(made):
    """The log, its nominal readings, and what is told without the law and with it."""
    log, problem, nominal, best, before = made
    return log, nominal, before, explained_by(missing_with(best=best), log, problem, nominal, before)


def test_the_gap_is_that_before_and_with_the_law(told):
    *_, found = told
    # Half of the readings are off by 10 sigma u, u even in 0 ... 1: mean square 1 + 100 / 6.
    assert found.gap.before == pytest.approx(np.sqrt(1 + 100 / 6), rel=0.05)
    # 800 samples: the root mean square of noise is known to 1 / sqrt(1600).
    assert found.gap.after == pytest.approx(1.0, abs=3.5 / 40)


def test_explained_readings_are_with_the_law(told):
    log, nominal, _, found = told
    (law,), (without,) = found.explained, nominal
    np.testing.assert_allclose(law["tip_angle_deg"], without["tip_angle_deg"])
    drift = law["base_torque_n_mm"] - without["base_torque_n_mm"]
    np.testing.assert_allclose(drift, np.linspace(0.0, RISE, drift.size), atol=0.01 * RISE)
    assert law["tip_angle_deg"].size == len(log.trials[0].table)


def test_what_is_left_is_that_of_the_law_and_everything_else_stands(told):
    *_, before, found = told
    for sensor in SENSORS:
        assert found.breakdown_after.signal[sensor] == pytest.approx(1.0, abs=3.5 / np.sqrt(800))
    assert found.shape_after is not None
    changed = {"gap", "explained", "breakdown_after", "shape_after", "next_experiment"}
    changed |= {"sensors"}
    kept = {name for name in vars(before) if getattr(found, name) is getattr(before, name)}
    assert kept == set(vars(before)) - changed


def test_the_shape_of_the_shaft_is_that_with_the_law(made):
    """Not that of the nearest explanation: a sensor that drifts leaves the nominal shape."""
    log, problem, nominal, best, before = made
    nearest = {"nominal": NOMINAL, "tip_drag": NOMINAL, "explained": RigParameters(damping_scale=2.0)}
    twisted = shaft_twist(problem.log, log.trials[0].name, 3.0, nearest)
    before = replace(before, twist=twisted)
    found = explained_by(missing_with(best=best), log, problem, nominal, before).twist
    assert (found.trial, found.at_s) == (twisted.trial, twisted.at_s)
    assert set(found.along) == {"nominal", "explained"}
    np.testing.assert_array_equal(found.along["explained"], found.along["nominal"])
    assert np.abs(twisted.along["explained"] - found.along["explained"]).max() > 1.0


def test_imperfections_of_sensors_are_those_that_the_law_allows_for(told):
    """Not those of the nearest explanation, whose clock made up for what is missing."""
    *_, found = told
    none = dict.fromkeys(SENSORS, 0.0)
    assert found.sensors == replace(CLOCK_ERRORS, imperfections={}, drift_sigma=none)


@pytest.mark.parametrize(
    ("unseen", "predicted", "after"),
    [(3.0, 1.0, 3.0), (90.0, 1.0, 1.0), (90.0, 6.0, 90.0)],
    ids=["a prediction", "led on to anywhere, which is no surprise", "a wrong prediction"],
)
def test_unseen_trials_count_unless_the_law_is_led_on_to_where_no_trial_tells(
    made, unseen, predicted, after
):
    log, problem, nominal, best, before = made
    left = (np.full(best.fit.by_trial[0].size, unseen),)
    best = replace(best, held_out=left, gap_after=predicted)
    missing = missing_with(best=best, closed=predicted <= CLOSED_GAP)
    found = explained_by(missing, log, problem, nominal, before)
    assert found.gap.after == pytest.approx(after, abs=3.5 / 40)


def test_of_readings_that_no_other_trial_tells_of_what_the_fit_leaves_counts(made):
    """The slopes of half of them leave them open by more than the noise."""
    log, problem, nominal, best, before = made
    left = best.fit.by_trial[0]
    slopes = np.zeros_like(best.fit.jacobian[0])
    slopes[: left.size // 2] = 1e3
    best = replace(best, fit=replace(best.fit, jacobian=(slopes,)), held_out=(np.full(left.size, 3.0),))
    found = explained_by(missing_with(best=best, closed=False), log, problem, nominal, before)
    # Half of the squares are 9, and half are those of noise.
    assert found.gap.after == pytest.approx(np.sqrt((9.0 + 1.0) / 2), abs=3.5 / np.sqrt(2 * left.size))
