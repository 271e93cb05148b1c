"""Drag at the tip, at the entry or in the sheath that grows with a power of the rate."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import VOCABULARY, covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.in_one_place.power import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
FAMILY, *ALONG = families(covered(ANGLE, tip=ANGLE))


def test_with_the_power_one_it_is_the_drag_of_the_library():
    assert same_readings(
        ANGLE, FAMILY.effect.apply(NOMINAL, 0.2, 1.0), LIBRARY["tip_drag"].apply(NOMINAL, 0.2)
    )
    assert not same_readings(
        ANGLE, FAMILY.effect.apply(NOMINAL, 0.2, 2.0), LIBRARY["tip_drag"].apply(NOMINAL, 0.2)
    )


@pytest.mark.parametrize("exponent", [0.5, 2.0])
def test_its_torque_is_that_power_of_the_rate(exponent):
    rates, torques = (np.array(own) for own in FAMILY.curve(0.3, exponent))
    fast = np.abs(rates) > 0.1  # the plateau of 0.001 rad/s changes 5e-5 there
    expected = 0.3 * np.sign(rates) * np.abs(rates) ** exponent
    np.testing.assert_allclose(torques[fast], expected[fast], rtol=1e-4)


def test_it_is_of_one_place_and_its_strength_is_its_drag():
    free = FAMILY.effect.apply(NOMINAL, 0.3, 2.0).free
    (law,) = free.at_tip
    assert law.exponent == 2.0
    assert free.times(0.5).at_tip[0].viscous_n_mm_s_per_mm == pytest.approx(0.15)


@pytest.mark.parametrize(("family", "law"), [*zip(ALONG, ("at_entry", "in_sheath"), strict=True)])
def test_along_the_shaft_it_is_that_of_its_place(family, law):
    rig = family.effect.apply(NOMINAL, 0.05, 0.5)
    (own,) = getattr(rig.free, law)
    assert (own.viscous_n_mm_s_per_mm, own.exponent) == (0.05, 0.5)
    assert not same_readings(ANGLE, rig, NOMINAL)
    starts = {*zip(*(p.start for p in family.effect.parameters), strict=True)}
    assert len(starts) == 4


def test_what_it_depends_on_has_a_word_and_a_base_at_rest_has_none():
    assert FAMILY.says == "rate"
    assert FAMILY.says in VOCABULARY
    assert all(p.low <= s <= p.high for p in FAMILY.effect.parameters for s in p.start)
    assert families(covered(0.0 * ANGLE, tip=ANGLE)) == ()
