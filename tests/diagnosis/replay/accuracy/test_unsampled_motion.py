"""What the base did between two samples, as noise of what is predicted."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import NOISE, RIG, log_with, trial

from diagnosis.nominal_replay import replay_nominal
from diagnosis.prepare.prepare import prepare
from diagnosis.replay.accuracy import unsampled_motion
from diagnosis.replay.accuracy.unsampled_motion import weighted_by_unsampled_motion
from diagnosis.replay.replay import predict, replay
from diagnosis.replay.rig_parameters import NOMINAL

TORQUE, TIP = "base_torque_n_mm", "tip_angle_deg"
STEP, DENSE = 0.04, 0.004


RATE = 2.5 * np.pi  # rad/s
CORNERS = (1.513, 2.451, 3.389)


def corners(time):
    """Waves that turn round at once in a curved part, between samples."""
    since = np.minimum(np.abs(time - CORNERS[0]), np.abs(time - CORNERS[2]))
    return 30.0 * (np.cos(RATE * (since + 0.1)) - np.cos(RATE * (CORNERS[0] + 0.1)))


def straight_corners(time):
    return np.interp(time, [0, 1.013, 1.507, 3.021, 3.389, 5], [0, 0, 90, 90, -30, -30])


def smooth(time):
    return 60.0 * (1.0 - np.cos(0.8 * time))


def log_of(motion, step):
    """A prepared log of exact readings of the nominal needle, from a motion that is known everywhere."""
    dense = prepare(log_with(trial(motion(np.arange(0, 5, DENSE)), step=DENSE)))[0]
    seen = predict(RIG, dense.trials[0], [NOMINAL])[0]
    every = round(step / DENSE)
    rare = trial(motion(np.arange(0, 5, DENSE))[::every], step=step)
    table = rare.table.assign(**{s: seen[s][::every] for s in (TORQUE, TIP)})
    return prepare(log_with(replace(rare, table=table)))[0]


def test_the_error_that_is_told_is_that_of_the_prediction():
    """Within a factor of three: the corner may lie anywhere between two samples."""
    log = log_of(corners, STEP)
    predictions = replay(log)
    weighted, (warning,) = weighted_by_unsampled_motion(log, predictions, NOISE)
    own = weighted.trials[0]
    told = np.sqrt(1 / own.weights[TORQUE] ** 2 - 1)
    true = (own.readings[TORQUE] - predictions[0][TORQUE]) / NOISE[TORQUE]
    assert 1 / 3 < np.sqrt(np.mean(true**2) / np.mean(told**2)) < 3.0
    assert TORQUE in warning
    assert "too rarely" in warning


def test_only_samples_near_a_corner_count_for_less():
    log = log_of(corners, STEP)
    own = weighted_by_unsampled_motion(log, replay(log), NOISE)[0].trials[0]
    apart = np.min(np.abs(own.time_s[:, None] - CORNERS), axis=1)
    assert own.weights[TORQUE][apart < 2 * STEP].max() < 0.6
    assert own.weights[TORQUE][(apart > 10 * STEP) & (own.time_s > 0.3)].min() > 0.75
    assert TIP not in own.weights  # the tip follows slowly: nothing of a corner is left there


@pytest.mark.parametrize(
    ("motion", "step"), [(smooth, STEP), (straight_corners, STEP), (corners, DENSE)]
)
def test_where_samples_tell_the_motion_nothing_changes(motion, step):
    """Two straight lines tell the corner between them."""
    log = log_of(motion, step)
    weighted, warnings = weighted_by_unsampled_motion(log, replay(log), NOISE)
    assert weighted is log
    assert warnings == ()


@pytest.mark.parametrize(("noise", "replays"), [(1.0, 6), (1000.0, 2)])
def test_where_half_the_samples_do_as_well_a_quarter_is_not_asked_for(noise, replays, monkeypatch):
    log = log_of(corners, STEP)
    predictions, made = replay(log), []
    monkeypatch.setattr(unsampled_motion, "replay", lambda own: made.append(own) or replay(own))
    weighted_by_unsampled_motion(log, predictions, replace(NOISE, sigma=scaled(NOISE.sigma, noise)))
    assert len(made) == replays


def scaled(sigma, factor):
    return {sensor: factor * size for sensor, size in sigma.items()}


def test_weights_that_are_there_stay():
    log = log_of(corners, STEP)
    trials = (replace(log.trials[0], weights={TORQUE: 0.5 * np.ones(log.trials[0].time_s.size)}),)
    once, twice = (
        weighted_by_unsampled_motion(own, replay(log), NOISE)[0].trials[0].weights[TORQUE]
        for own in (log, replace(log, trials=trials))
    )
    np.testing.assert_allclose(twice, 0.5 * once)


def test_the_nominal_replay_tells_of_it_and_corners_add_less_to_its_gap():
    rng = np.random.default_rng(4)
    exact = log_of(corners, STEP).trials[0]
    measured = trial(exact.base_motion_deg, step=STEP)
    noisy = {s: exact.readings[s] + rng.normal(0, NOISE[s], exact.time_s.size) for s in (TORQUE, TIP)}
    found = replay_nominal(log_with(replace(measured, table=measured.table.assign(**noisy))))
    assert any("too rarely" in warning for warning in found.problem.noise.warnings)
    plain = replace(found.problem.log.trials[0], weights={})
    bare = replace(found.problem, log=replace(found.problem.log, trials=(plain,)))
    without_weights = bare.residuals([found.rig])[0][0]
    assert found.fit.gap < np.sqrt(np.mean(without_weights**2)) - 0.03
