"""The moment of the largest residual."""

import numpy as np
import pytest
from diagnosis_fixtures import trial

from diagnosis.residuals.largest_moment import largest_moment
from diagnosis.residuals.trial_residual import TrialResidual


def residual(left, name="trial_01.csv"):
    """A trial at 100 Hz that leaves this of its tip sensor, in sigma."""
    return TrialResidual(trial=trial(np.zeros(left.size), name=name), left={"tip_angle_deg": left})


def bump(at_s, size, seed=0):
    """Noise, and half a second that is off."""
    left = np.random.default_rng(seed).normal(size=1000)
    left[round(100 * at_s) - 25 : round(100 * at_s) + 25] += size
    return left


def test_the_moment_is_in_the_middle_of_what_is_off_and_in_its_trial():
    quiet, loud = residual(bump(3.0, 2.0)), residual(bump(7.0, -6.0), "trial_02.csv")
    name, at_s = largest_moment([quiet, loud])
    assert name == "trial_02.csv"
    assert at_s == pytest.approx(7.0, abs=0.25)


def test_an_outlier_is_no_moment():
    left = bump(3.0, 6.0)
    left[800] += 50.0  # 2 sigma over a quarter of a second
    assert largest_moment([residual(left)])[1] == pytest.approx(3.0, abs=0.25)


def test_what_was_not_read_counts_for_nothing():
    left = bump(3.0, 6.0)
    left[500:] = np.nan
    assert largest_moment([residual(left)])[1] == pytest.approx(3.0, abs=0.25)


def test_a_trial_without_sensors_is_its_start():
    nothing = TrialResidual(trial=trial(np.zeros(50)), left={})
    assert largest_moment([nothing]) == ("trial_01.csv", 0.0)
