"""Torque at the base against lag, and the gain of a display."""

import numpy as np
import pytest

from models.errors import InvalidValue
from models.haptics import felt_lag_deg, gain_needed, torque_n_mm_per_deg
from models.modes import InsertedNeedle
from models.needle import NEEDLES, NITINOL

SLOW = {"free_mm": 230.0, "inserted_mm": 100.0}


def test_the_papers_own_pairs_of_torque_and_lag_have_this_stiffness():
    # SimTest: 1.0 N mm and nearly 50 deg; Podder et al. in 1.27 mm Nitinol: 7 N mm and about 11 deg.
    assert torque_n_mm_per_deg(NITINOL, **SLOW) == pytest.approx(1.0 / 50, rel=0.02)
    thick = torque_n_mm_per_deg(NEEDLES["nitinol-1.27"], free_mm=150.0, inserted_mm=50.0)
    assert thick == pytest.approx(7.0 / 11, rel=0.1)


def test_it_is_torque_over_lag_of_the_closed_form_at_a_constant_rate():
    held = InsertedNeedle(needle=NITINOL, damping_n_mm_s_per_mm=0.017, inserted_mm=100.0, free_mm=50.0)
    time = np.array([0.0, 30.0])
    response = held.respond(time, 0.1 * time, count=4000)
    lag_deg = np.degrees(3.0 - response.tip_rad[-1])
    # The series of the torque converges as 1 / k with a free length: 1e-4 at 4000 modes.
    expected = response.base_torque_n_mm[-1] / lag_deg
    stiffness = torque_n_mm_per_deg(NITINOL, free_mm=50.0, inserted_mm=100.0)
    assert stiffness == pytest.approx(expected, rel=1e-3)


def test_the_torque_leads_the_lag_while_the_tip_has_not_begun_to_turn():
    held = InsertedNeedle(needle=NITINOL, damping_n_mm_s_per_mm=0.017, inserted_mm=200.0, free_mm=50.0)
    time = np.linspace(0.0, 0.3, 31)
    response = held.respond(time, 5.0 * time, count=400)
    lag_deg = np.degrees(5.0 * time - response.tip_rad)
    ratio = response.base_torque_n_mm[10:] / lag_deg[10:]
    assert ratio.min() > torque_n_mm_per_deg(NITINOL, free_mm=50.0, inserted_mm=200.0)


def test_a_lag_is_just_felt_with_the_gain_that_it_needs():
    gain = gain_needed(NITINOL, threshold_n_mm=7.6, lag_deg=3.0, **SLOW)
    assert felt_lag_deg(NITINOL, threshold_n_mm=7.6, gain=gain, **SLOW) == pytest.approx(3.0)
    assert gain == pytest.approx(125.6, abs=0.1)  # the number of docs/simulation.md
    # Twice the gain, half the lag; a threshold of the needle's own torque needs none.
    assert felt_lag_deg(NITINOL, threshold_n_mm=7.6, gain=2 * gain, **SLOW) == pytest.approx(1.5)
    own = 3.0 * torque_n_mm_per_deg(NITINOL, **SLOW)
    assert gain_needed(NITINOL, threshold_n_mm=own, lag_deg=3.0, **SLOW) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("field", "value"),
    [("threshold_n_mm", 0.0), ("lag_deg", -1.0), ("free_mm", -1.0), ("inserted_mm", np.nan)],
)
def test_what_cannot_be_is_refused(field, value):
    good = {"threshold_n_mm": 1.0, "lag_deg": 3.0, **SLOW}
    with pytest.raises(InvalidValue, match=field):
        gain_needed(NITINOL, **(good | {field: value}))


def test_a_needle_without_length_or_a_display_without_gain_is_refused():
    with pytest.raises(InvalidValue, match="inserted_mm"):
        torque_n_mm_per_deg(NITINOL, free_mm=0.0, inserted_mm=0.0)
    with pytest.raises(InvalidValue, match="gain"):
        felt_lag_deg(NITINOL, threshold_n_mm=1.0, gain=0.0, **SLOW)
