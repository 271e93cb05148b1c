"""Values of a simulated signal between its samples."""

import numpy as np

from diagnosis.replay.interpolation import interpolated

STEPS = np.arange(0.0, 2.0, 0.01)


def fast(time_s):
    """A turn at 3 Hz, deg."""
    return 30.0 * np.sin(2 * np.pi * 3.0 * time_s)


def test_a_fast_turn_is_followed_between_its_samples():
    """A straight line is off by a h^2 / 8 = 0.13 deg in the middle between two samples.

    Akima's slopes are between those of the chords on both sides, which differ by h^2 a' where the
    acceleration changes its sign: off by h^3 a' / 8 = 0.025 deg if both ends are at their worst.
    """
    between = STEPS[3:-4] + 0.005
    straight = np.abs(np.interp(between, STEPS, fast(STEPS)) - fast(between)).max()
    followed = np.abs(interpolated(between, STEPS, fast(STEPS)) - fast(between)).max()
    assert straight > 0.1
    assert followed < 0.02


def test_samples_are_as_they_are_and_ends_hold():
    values = fast(STEPS)
    assert np.array_equal(interpolated(STEPS, STEPS, values), values)
    ends = interpolated(np.array([-1.0, 0.995, 5.0]), STEPS, values)
    assert (ends[0], ends[-1]) == (values[0], values[-1])


def test_a_jump_is_not_overshot():
    jump = np.where(STEPS < 1.0, -5.0, 5.0)
    assert np.abs(interpolated(STEPS[:-1] + 0.005, STEPS, jump)).max() <= 5.0 + 1e-9


def test_two_samples_are_a_straight_line():
    assert interpolated(np.array([0.25]), np.array([0.0, 1.0]), np.array([0.0, 4.0]))[0] == 1.0


def test_several_signals_at_once_are_as_each_alone():
    signals = np.stack([fast(STEPS), np.sign(np.sin(STEPS)), STEPS**2], axis=-1)
    for at_s in (STEPS[:-1] + 0.003, STEPS, np.array([-1.0, 0.5, 9.0])):
        alone = [interpolated(at_s, STEPS, one) for one in signals.T]
        np.testing.assert_array_equal(interpolated(at_s, STEPS, signals), np.stack(alone, axis=-1))
