"""Events: once, in one trial."""

import numpy as np

from validation.rig.unmodelled.effect import once


def test_an_event_is_in_its_trial_at_its_share_of_the_time():
    time_s = np.linspace(0, 10, 101)
    parameters = {"trial": 1.0, "share": 0.4}
    assert (once(time_s, 1, parameters) == (time_s > 4.0)).all()
    assert not once(time_s, 0, parameters).any()
