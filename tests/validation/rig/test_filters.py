"""What trails behind a signal."""

import numpy as np
import pytest

from validation.rig.filters import followed_with_play, low_passed


def test_a_low_pass_answers_a_ramp_in_closed_form():
    """Of slope 1 from 0: t - tau (1 - exp(-t / tau)), whatever the step."""
    time_s = np.linspace(0, 2, 9)
    expected = time_s - 0.3 * (1 - np.exp(-time_s / 0.3))
    assert low_passed(time_s, 0.25, 0.3) == pytest.approx(expected)


def test_play_is_crossed_before_what_follows_moves():
    values = np.array([0.0, 1.0, 3.0, 2.0, 0.5, -4.0])
    assert followed_with_play(values, 1.0) == pytest.approx([0.0, 0.0, 2.0, 2.0, 1.5, -3.0])
