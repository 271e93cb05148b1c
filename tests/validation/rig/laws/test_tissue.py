"""The tissue at the shaft: its stiffness over time and depth, and its hardening."""

import math

import pytest

from validation.rig.laws.parameters import LawParameters
from validation.rig.laws.tissue import hardening_twist, tissue_compliance

LAW = LawParameters(323.6, 0.018, 0.295, compliance=20.0)


def test_a_plain_tissue_is_the_same_at_any_time_and_depth():
    assert tissue_compliance(LAW, 7.0, 30.0) == 20.0


def test_stiffness_falls_with_time_and_grows_with_depth():
    softer = LAW._replace(softened_share=0.5, softening_time=4.0)
    assert tissue_compliance(softer, 0.0, 0.0) == 20.0
    assert tissue_compliance(softer, 4.0, 0.0) == pytest.approx(20.0 / (0.5 + 0.5 / math.e))
    assert tissue_compliance(LAW._replace(stiffening=3.0), 0.0, 50.0) == pytest.approx(20.0 / 2.5)


@pytest.mark.parametrize("forced", [-40.0, 1e-3, 0.5, 1e4])
def test_a_hardening_twist_solves_its_cubic(forced):
    twist = hardening_twist(30.0, 1.5, forced)
    assert 1.5 * twist + 30.0 * twist**3 == pytest.approx(forced, rel=1e-9)
    assert hardening_twist(0.0, 1.5, forced) == forced / 1.5
