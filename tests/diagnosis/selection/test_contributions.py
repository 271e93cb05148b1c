"""What each of several effects contributes."""

import numpy as np
import pytest
from diagnosis_fixtures import log_of, problem_of

from diagnosis.fitting.fit import fit_effects
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.candidate import candidate
from diagnosis.selection.contributions import strongest_first


@pytest.mark.parametrize(
    ("bias_deg", "torque", "first"), [(1.0, 0.01, "tip_angle_bias"), (0.25, 0.04, "torque_bias")]
)
def test_the_stronger_of_two_is_told_first(bias_deg, torque, first):
    """4 sigma of one, 1 sigma of the other."""
    rig = RigParameters(tip_bias_deg=bias_deg, torque_bias_n_mm=torque)
    problem = problem_of(log_of(rig, seconds=4.0))
    fit = fit_effects(problem, ("tip_angle_bias", "torque_bias"))
    names = strongest_first(problem, candidate(fit))
    assert names[0] == first
    assert set(names) == {"tip_angle_bias", "torque_bias"}


def test_one_effect_needs_no_order():
    problem = problem_of(log_of(RigParameters(tip_bias_deg=1.0), seconds=2.0))
    fit = fit_effects(problem, ("tip_angle_bias",))
    assert strongest_first(problem, candidate(fit)) == ("tip_angle_bias",)
    assert np.isfinite(fit.cost)
