"""Drag of a tip that has turned far: a level curve is the library's, and its turns are its own."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns
from free_forms import covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.contact.tip_over_slip import families
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL
from models.contact import CONTACT_POINTS

ANGLE, DRAG = turns(6.0), 0.2
(FAMILY,) = families(covered(ANGLE, tip=ANGLE))
LEVEL = (0.0,) * CONTACT_POINTS


def test_a_level_curve_is_the_drag_of_the_library():
    drag = LIBRARY["tip_drag"].apply(NOMINAL, DRAG)
    assert same_readings(ANGLE, FAMILY.effect.apply(NOMINAL, DRAG, *LEVEL), drag)
    rising = (0.0, 1.0, *LEVEL[2:])
    assert not same_readings(ANGLE, FAMILY.effect.apply(NOMINAL, DRAG, *rising), drag)


def test_the_curve_that_is_told_is_that_of_the_law():
    c = (0.2, 0.7, *LEVEL[2:])
    (law,) = FAMILY.effect.apply(NOMINAL, DRAG, *c).free.at_tip
    at, told = map(np.asarray, FAMILY.curve(DRAG, *c))
    np.testing.assert_allclose(law.contact.places, at)
    np.testing.assert_allclose(told, 0.03 * DRAG * np.array(law.contact.factors))


def test_it_counts_what_the_tip_has_turned_not_the_base():
    """Of a tip that holds while the base shakes, drag that rises only after far turns does not rise."""
    shaken = 20.0 * np.sin(0.4 * np.arange(600))
    own = prepared(trial(shaken))
    firm = FAMILY.effect.apply(NOMINAL, 7.0, *LEVEL)
    (level,) = predict(RIG, own, [firm])
    by_tip, by_base = (np.abs(np.diff(a)).sum() for a in (level.tip_angle_deg, shaken))
    (law,) = firm.free.at_tip
    beyond = np.where(law.contact.places > 2.0 * by_tip, 5.0, 1.0)
    assert by_base > law.contact.places[np.argmax(beyond > 1.0)]  # by its turns it would rise
    contact = law.contact.but(factors=tuple(beyond))
    late = replace(firm, free=replace(firm.free, at_tip=(law.but(contact=contact),)))
    (found,) = predict(RIG, own, [late])
    np.testing.assert_allclose(found.tip_angle_deg, level.tip_angle_deg, atol=0.02)
    soon = law.contact.but(factors=(5.0,) * CONTACT_POINTS)
    other = replace(firm, free=replace(firm.free, at_tip=(law.but(contact=soon),)))
    (moved,) = predict(RIG, own, [other])
    assert np.abs(moved.tip_angle_deg - level.tip_angle_deg).max() > 0.2


def test_fits_start_from_a_drag_that_stays_and_from_one_that_falls_to_a_small_part():
    """A step from a level curve does not get to a drag that is gone after some turns."""
    drag, level, slope, *_ = FAMILY.effect.parameters
    own = LIBRARY["tip_drag"].parameters[0].start
    assert [(d, s) for d in own for s in (0.0, -2.0)] == list(zip(drag.start, slope.start, strict=True))
    assert set(level.start) == {0.0}
    (_, (first, *_, last)) = FAMILY.curve(1.0, 0.0, -2.0, *LEVEL[2:])
    assert last / first == pytest.approx(np.exp(-4.0))


def test_a_base_that_does_not_turn_has_no_such_law():
    assert families(covered(0.0 * ANGLE, tip=ANGLE)) == ()
