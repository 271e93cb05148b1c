"""Signs and zeros of columns that were flipped and shifted, and of those that were not."""

import numpy as np
import pytest
from analytic_log import BASE, SLIDES, TIP, TORQUE, TURNS

from diagnosis.lab_files.guesses.signs import speed_sign, tip_sign, torque_sign, zero_at_rest
from diagnosis.lab_files.motion import motion_of

TIME, BASE_DEG = TURNS["time_s"].to_numpy(), TURNS["base_angle_deg"].to_numpy()
TORQUE_N_MM, TIP_DEG = TURNS["base_torque_n_mm"].to_numpy(), TURNS["tip_angle_deg"].to_numpy()
NOISE = np.random.default_rng(5).normal(size=TIME.size)


@pytest.mark.parametrize("sign", [1, -1])
def test_a_flipped_torque_is_told_from_one_that_is_not(sign):
    assert torque_sign(sign * TORQUE_N_MM, BASE_DEG).sign == sign


@pytest.mark.parametrize("sign", [1, -1])
def test_a_flipped_tip_is_told_from_one_that_is_not(sign):
    assert tip_sign(TIME, sign * TIP_DEG, BASE_DEG).sign == sign


def test_noise_has_no_sign():
    assert torque_sign(NOISE, BASE_DEG).sign is None
    assert tip_sign(TIME, NOISE, BASE_DEG).sign is None


@pytest.mark.parametrize("sign", [1, -1])
def test_a_flipped_speed_is_told_from_one_that_is_not(sign):
    time, free = SLIDES["time_s"].to_numpy(), SLIDES["free_mm"].to_numpy()
    speed = sign * SLIDES["speed_mm_s"].to_numpy()
    assert speed_sign(time, speed, free, depth_grows=False).sign == sign
    assert speed_sign(time, speed, -free, depth_grows=True).sign == sign
    assert speed_sign(time, speed, np.full(time.size, 70.0), depth_grows=True).sign is None


def test_an_offset_is_found_at_rest_to_within_its_uncertainty():
    """About 85 samples of the first second are at rest."""
    motion = motion_of(TIME, BASE_DEG)
    guess = zero_at_rest(TORQUE_N_MM + 0.5, TIME, motion, TORQUE)
    assert guess.value == pytest.approx(0.5, abs=4 * TORQUE / np.sqrt(80))


@pytest.mark.parametrize(("values", "noise"), [(TORQUE_N_MM, TORQUE), (TIP_DEG, TIP), (BASE_DEG, BASE)])
def test_what_reads_0_at_rest_keeps_its_zero(values, noise):
    assert zero_at_rest(values, TIME, motion_of(TIME, BASE_DEG), noise).value == 0


def test_a_trial_that_starts_in_motion_tells_no_zero():
    later = TIME > 1.3
    motion = motion_of(TIME[later], BASE_DEG[later])
    assert zero_at_rest(TORQUE_N_MM[later], TIME[later], motion, TORQUE).value is None
