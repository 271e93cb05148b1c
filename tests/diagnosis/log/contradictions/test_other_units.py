"""One trial in another unit: refused where its scatter and its swing say so, and only there."""

import numpy as np
import pytest
from analytic_log import SLIDES, TURNS, change_trial, refusal, scaled

from diagnosis.log.contradictions.other_units import refuse_other_units
from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.trial import Trial, UnusableLog

RAD = np.pi / 180


def reread(log, change):
    """Read a log of which one trial was changed."""
    change_trial(log, change, "slides.csv")
    return read_rig_log(log)


def test_a_tip_in_radians_in_one_trial_is_refused(log):
    change_trial(log, scaled("tip_angle_deg", RAD), "slides.csv")
    said = refusal(log)
    assert "slides.csv: tip_angle_deg seems to be in rad" in said
    assert "multiply it by 57.2958" in said


def test_a_torque_in_newton_metres_in_one_trial_is_refused(log):
    change_trial(log, scaled("base_torque_n_mm", 1e-3), "slides.csv")
    assert "base_torque_n_mm seems to be in N m" in refusal(log)


def test_a_quiet_sensor_of_the_usual_swing_is_no_other_unit(log):
    """A filter leaves the motion: only the scatter is smaller."""
    noise = read_rig_log(log).rig.sensors.by_column()
    rng = np.random.default_rng(6)
    quiet = SLIDES.assign(
        tip_angle_deg=0.8 * SLIDES["base_angle_deg"] + rng.normal(0, 0.4 * RAD, len(SLIDES))
    )
    trials = [Trial(name="turns.csv", table=TURNS), Trial(name="slides.csv", table=quiet)]
    refuse_other_units([log / one.name for one in trials], trials, noise)
    radians = quiet.assign(tip_angle_deg=RAD * SLIDES["tip_angle_deg"])
    trials = [trials[0], Trial(name="slides.csv", table=radians)]
    with pytest.raises(UnusableLog, match="in rad"):
        refuse_other_units([log / one.name for one in trials], trials, noise)


def test_a_tip_that_hardly_turns_is_no_other_unit(log):
    """It scatters as claimed: only the swing is smaller."""
    rng = np.random.default_rng(7)
    stuck = RAD * SLIDES["tip_angle_deg"] + rng.normal(0, 0.4, len(SLIDES))
    assert reread(log, lambda t: t.assign(tip_angle_deg=stuck)).trials


@pytest.mark.parametrize(("factor", "refused"), [(1e3 * RAD, False), (RAD, True)])
def test_a_base_that_scatters_and_swings_more_is_no_other_unit_but_one_that_does_both_less_is(
    log, factor, refused
):
    """By 17, as of mrad: it turns faster between two samples. By 57: it is in radians."""
    noise = read_rig_log(log).rig.sensors.by_column()
    time_s = np.arange(0.0, 10.0, 0.02)
    rng = np.random.default_rng(8)
    usual = 20.0 * np.sin(time_s) + rng.normal(0, noise["base_angle_deg"], time_s.size)
    tables = [TURNS.iloc[: time_s.size].assign(base_angle_deg=usual * by) for by in (1.0, factor)]
    trials = [Trial(name=name, table=table) for name, table in zip("ab", tables, strict=True)]
    paths = [log / one.name for one in trials]
    if not refused:
        refuse_other_units(paths, trials, noise)
        return
    with pytest.raises(UnusableLog, match="base_angle_deg seems to be in rad"):
        refuse_other_units(paths, trials, noise)


def test_a_log_that_is_in_another_unit_throughout_is_left_to_the_warnings(log):
    """No trial says then what the claim is worth."""
    change_trial(log, scaled("tip_angle_deg", RAD))
    assert any("radians" in said for said in reread(log, scaled("tip_angle_deg", RAD)).warnings)
