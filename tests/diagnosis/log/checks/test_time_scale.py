"""How late the needle follows, beside the stated one."""

import numpy as np
import pytest
from analytic_log import STEP_S, change_trial, lagging, scaled
from diagnosis_fixtures import RIG, prepared, trial, turns

from diagnosis.log.checks.time_scale import nominal_lag_s
from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.trial import UnusableLog
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL

DAMPING = RIG.tissue.damping_n_mm_s_per_mm


def without_tip(t):
    return t.drop(columns="tip_angle_deg")


def test_the_nominal_lag_is_that_of_the_simulated_needle():
    """A first-order lag stands for a sum of modes: within a fifth."""
    one = trial(turns())
    tip = predict(RIG, prepared(one), [NOMINAL])[0]["tip_angle_deg"]
    lag = nominal_lag_s(one, RIG.rigidity_n_mm2, DAMPING)
    lags = lag * np.array([0.5, 0.8, 1.0, 1.25, 2.0])
    left = [_unexplained(one["base_angle_deg"], tip, own) for own in lags]
    assert int(np.argmin(left)) in (1, 2, 3)
    assert min(left) < 0.01


def _unexplained(base, tip, lag_s):
    gain = STEP_S / lag_s
    copy = np.zeros(base.size)
    for i in range(1, base.size):
        copy[i] = copy[i - 1] + gain * (base[i] - copy[i - 1])
    return 1 - np.corrcoef(copy, tip)[0, 1] ** 2


@pytest.mark.parametrize("seen", [lambda t: t, without_tip])
@pytest.mark.parametrize(("factor", "pace"), [(1 / 60, "far sooner"), (300.0, "far later")])
def test_times_in_another_unit_are_told(log, seen, factor, pace):
    change_trial(log, lambda t: seen(scaled("time_s", factor)(t)))
    said = [w for w in read_rig_log(log).warnings if w.startswith("turns.csv: the needle follows")]
    assert len(said) == 1
    assert pace in said[0]
    assert "check units of time_s" in said[0]


def test_times_a_million_times_too_small_are_refused(log):
    change_trial(log, scaled("time_s", 1e-6))
    with pytest.raises(
        UnusableLog, match=r"turns.csv, column 'time_s': expected samples at least 1e-05 s"
    ):
        read_rig_log(log)


@pytest.mark.parametrize("lag_s", [0.1, 3.0])
def test_a_rig_that_is_five_times_sooner_or_later_is_no_fault(log, lag_s):
    """The nominal lag is 0.58 s."""
    lagging(([0, 1, 2, 6, 7, 12], [0, 0, 90, 90, -30, -30]), lag_s).to_csv(
        log / "turns.csv", index=False
    )
    assert read_rig_log(log).warnings == ()


def test_a_motion_that_tells_no_lag_is_not_judged(log):
    """So slow that the tip is where the base is, whatever the lag."""
    lagging(([0, 60], [0, 30]), 0.01).to_csv(log / "turns.csv", index=False)
    assert read_rig_log(log).warnings == ()
