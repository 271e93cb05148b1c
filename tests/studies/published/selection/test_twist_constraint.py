"""What the paper's twist test rules out."""

import pytest
from reference_fits import fit_with

from diagnosis.replay.rig_parameters import RigParameters
from studies.published.selection.twist_constraint import contradiction, twist_test_torque_n_mm


def test_the_stated_shaft_gives_the_measured_torque():
    # The printed G, 27.2 GPa, and torque, 1.24 N mm, are rounded by up to 0.2 % and 0.4 %.
    assert twist_test_torque_n_mm(fit_with(("a",), 0.0)) == pytest.approx(1.24, rel=6e-3)


def test_the_twist_test_rules_out_another_stiffness_and_a_soft_chuck():
    assert contradiction(fit_with(("a",), 0.0)) == ""
    stiff = contradiction(fit_with(("a",), 0.0, model=RigParameters(stiffness_scale=2.0)))
    assert stiff == "the twist test of Section II-A measured 1.24 N mm; predicted are 2.48 N mm"
    assert contradiction(fit_with(("a",), 0.0, model=RigParameters(base_stiffness_n_mm_per_rad=1.0)))
