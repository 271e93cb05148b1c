"""Readings of a loaded tip beyond the tissue: T l / kappa, where the length tells it."""

import numpy as np
import pytest
from analytic_log import TURNS, change_trial

from diagnosis.criteria.faults import TWIST_BEYOND_SIGMA
from diagnosis.log.faults.scatter import scatter
from diagnosis.log.faults.twist_beyond import without_twist_beyond
from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.trial import TIP, Trial

RIGIDITY_N_MM2 = 300.0
TORQUE_N_MM = 1.5


def out_by(mm, torque=TORQUE_N_MM):
    """A trial in which the needle comes out of the tissue by that length."""
    share = np.linspace(0.0, 1.0, len(TURNS))
    free = TURNS["free_mm"].iloc[0] - mm * share
    moved = TURNS.assign(free_mm=free, inserted_mm=80.0, tip_torque_n_mm=torque)
    return Trial(name="slides.csv", table=moved.assign(speed_mm_s=mm / TURNS["time_s"].iloc[-1]))


def test_readings_are_left_out_from_the_twist_on_that_counts():
    noise_deg = 1.0
    trial, (said,) = without_twist_beyond(out_by(20.0), RIGIDITY_N_MM2, noise_deg)
    left_out = np.isnan(trial[TIP])
    length_mm = 20.0 * np.linspace(0.0, 1.0, len(TURNS))
    twist_deg = np.degrees(TORQUE_N_MM * length_mm / RIGIDITY_N_MM2)
    np.testing.assert_array_equal(left_out, twist_deg > TWIST_BEYOND_SIGMA * noise_deg)
    assert "together change by 20 mm" in said
    assert "by 5.7 deg or more" in said
    assert f"not used in {left_out.sum()} of {left_out.size} samples" in said


def test_before_the_needle_is_in_the_tissue_the_free_length_tells_nothing():
    """A needle of 140 mm that comes from outside: free is the distance from chuck to tissue."""
    free = np.linspace(160.0, 100.0, len(TURNS))
    inside = TURNS.assign(
        free_mm=free, inserted_mm=np.clip(140.0 - free, 0.0, None), tip_torque_n_mm=TORQUE_N_MM
    )
    trial = Trial(name="enters.csv", table=inside)
    assert without_twist_beyond(trial, RIGIDITY_N_MM2, 0.3) == (trial, [])


def test_a_row_that_is_too_long_is_no_shaft():
    one = out_by(0.0)
    row = len(TURNS) // 2
    free = one.table["free_mm"].where(np.arange(len(TURNS)) != row, one.table["free_mm"] + 30.0)
    trial = Trial(name="slides.csv", table=one.table.assign(free_mm=free))
    assert without_twist_beyond(trial, RIGIDITY_N_MM2, 0.3) == (trial, [])


def test_noise_that_is_not_claimed_is_that_of_the_readings():
    claimed, free_of_noise = (
        np.isnan(without_twist_beyond(out_by(20.0), RIGIDITY_N_MM2, noise)[0][TIP]).sum()
        for noise in (scatter(TURNS[TIP].to_numpy()), 0.0)
    )
    assert free_of_noise == claimed > 0


@pytest.mark.parametrize(
    ("mm", "torque", "noise_deg"),
    [
        (20.0, 0.0, 1.0),  # no torque twists it
        (0.5, TORQUE_N_MM, 0.01),  # what lengths may disagree by
        (20.0, TORQUE_N_MM, 20.0),  # far less than noise
    ],
)
def test_otherwise_a_trial_is_as_it_was(mm, torque, noise_deg):
    trial = out_by(mm, torque)
    assert without_twist_beyond(trial, RIGIDITY_N_MM2, noise_deg) == (trial, [])


@pytest.mark.parametrize(
    ("torque_n_mm", "shallower", "told"), [(1.0, False, 1), (0.0, False, 0), (1.0, True, 0)]
)
def test_shaft_beyond_the_tissue_that_a_torque_at_the_tip_twists_is_told(
    log, torque_n_mm, shallower, told
):
    """The needle is drawn back by 20 mm: through the tissue, or out of it."""

    def loaded(t):
        drawn_mm = t["free_mm"] - t["free_mm"].iloc[0]
        return t.assign(tip_torque_n_mm=torque_n_mm, inserted_mm=t["inserted_mm"] - shallower * drawn_mm)

    change_trial(log, loaded, "slides.csv")
    said = [w for w in read_rig_log(log).warnings if "slides.csv: free_mm and inserted_mm together" in w]
    assert len(said) == told
    assert all("change by 20 mm" in w for w in said)
