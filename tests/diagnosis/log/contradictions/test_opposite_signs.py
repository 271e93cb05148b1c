"""Signs of one trial: refused if they contradict each other."""

import pytest
from analytic_log import change_trial, read_rig_log, scaled

from diagnosis.log.contradictions.opposite_signs import refuse_backward_lengths
from diagnosis.log.trial import UnusableLog


def test_a_depth_that_shrinks_as_the_needle_goes_in_is_refused(log):
    trial = read_rig_log(log).trials[1]
    backward = trial.table.assign(inserted_mm=100.0 + 2.5 * trial["time_s"])
    refuse_backward_lengths(log, trial)
    with pytest.raises(UnusableLog, match="backwards"):
        refuse_backward_lengths(log, trial.__class__(name=trial.name, table=backward))


@pytest.mark.parametrize(
    ("column", "said"),
    [("tip_angle_deg", "turns the opposite way"), ("base_torque_n_mm", "works against base_angle_deg")],
)
def test_a_wrong_sign_of_one_trial_is_refused(log, column, said):
    change_trial(log, scaled(column, -1), "slides.csv")
    with pytest.raises(UnusableLog, match=rf"slides\.csv: {column} {said}"):
        read_rig_log(log)
