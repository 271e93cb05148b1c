"""What a log cannot tell."""

import pytest
from diagnosis_fixtures import log_of, log_with

from diagnosis.assessment import identifiability
from diagnosis.assessment.identifiability import unidentifiable
from diagnosis.log.trial import Trial
from diagnosis.replay.rig_parameters import NOMINAL


@pytest.fixture(scope="module")
def still():
    return log_of(NOMINAL, seconds=2.0)


def without(log, column):
    """The log without a column."""
    return log_with(*(Trial(name=t.name, table=t.table.drop(columns=column)) for t in log.trials))


def test_what_is_not_measured_cannot_be_told(still):
    blind = without(still, "tip_angle_deg")
    assert "tip_angle_bias" not in identifiability.testable_effects(blind)
    assert "tip_angle_bias" in identifiability.testable_effects(still)
    lines = unidentifiable(blind)
    assert any(line.startswith("Not testable:") and "tip_angle_bias" in line for line in lines)
    assert any(line.startswith("Without tip_angle_deg") for line in lines)


def test_without_torque_stiffness_and_damping_show_as_their_ratio(still):
    (line,) = (s for s in unidentifiable(without(still, "base_torque_n_mm")) if s.startswith("Without"))
    assert "stiffness_error and damping_error cannot be told apart" in line


def test_a_needle_that_never_slides_leaves_open_which_dry_friction_it_is(still):
    assert any("never slides" in line for line in unidentifiable(still))
    sliding = log_of(NOMINAL, speed=-1.0, seconds=2.0)
    assert not any("never slides" in line for line in unidentifiable(sliding))


def test_one_trial_at_one_depth_is_said(still):
    assert any("equally deep" in line for line in unidentifiable(still))
    assert any("one trial" in line for line in unidentifiable(still))
    deeper = Trial(name="b", table=still.trials[0].table.assign(inserted_mm=100.0))
    both = unidentifiable(log_with(*still.trials, deeper))
    assert not any("equally deep" in line or "one trial" in line for line in both)


def test_a_torque_at_the_tip_can_show_friction_by_load(still):
    assert "load_dependent_friction" not in identifiability.testable_effects(still)
    loaded = Trial(name="a", table=still.trials[0].table.assign(tip_torque_n_mm=0.1))
    assert "load_dependent_friction" in identifiability.testable_effects(log_with(loaded))
