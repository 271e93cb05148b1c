"""The state and the workspace: at rest, and without arrays in common."""

import numpy as np
import pytest

from validation.rig.state import initial_state, workspace


def test_a_trial_starts_untwisted_at_rest():
    state = initial_state(5, 7, 0.3)
    assert (state.angle == 0.3).all()
    assert (state.angle_before == 0.3).all()
    assert all(not values.any() for values in state[2:])
    assert (state.angle.size, state.tissue_twist.size, state.lumped.size) == (5, 7, 3)


@pytest.mark.parametrize("make", [lambda: initial_state(5, 7, 0.3), lambda: workspace(5)])
def test_arrays_share_no_memory(make):
    arrays = make()
    for i, array in enumerate(arrays):
        assert not any(np.shares_memory(array, other) for other in arrays[:i])
