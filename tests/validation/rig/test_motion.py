"""The inputs of a trial."""

import numpy as np
import pytest

from validation.rig.motion import CONSTANT_LENGTH_MM


def test_the_time_grid_starts_at_zero_with_even_steps(drive):
    motion = drive(dt=0.01, end=1.0)
    assert motion.time_s[0] == 0.0
    assert motion.time_s[-1] == pytest.approx(1.0)
    assert np.diff(motion.time_s) == pytest.approx(0.01)


@pytest.mark.parametrize(
    ("speed", "growing", "grows"),
    [(0.0, False, False), (2.0, False, False), (2.0, True, True), (-2.0, True, True)],
)
def test_a_trial_grows_if_its_depth_changes(drive, speed, growing, grows):
    assert drive(speed=speed, growing=growing).growing is grows


def test_a_depth_that_changes_by_rounding_is_constant(drive):
    assert not drive(speed=CONSTANT_LENGTH_MM / 10, growing=True, end=3.0).growing
