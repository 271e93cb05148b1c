"""Words for places and variables."""

from diagnosis_fixtures import turns
from free_forms import VOCABULARY, covered

from diagnosis.effects.effect import Place
from diagnosis.freeform.families import families_of
from diagnosis.freeform.missing.words import PLACES, VARIABLES, check_of


def test_every_place_and_variable_has_words():
    assert set(PLACES) == set(Place)
    assert set(VARIABLES) == VOCABULARY


def test_what_acts_about_the_axis_is_checked_while_the_needle_turns():
    """A needle that slides without turning shows errors of sensors, and no torque about its axis."""
    assert "turn at one steady rate while sliding" in check_of(Place.INTERFACE, "axial_speed")
    assert "without turning" in check_of(Place.SENSOR, "axial_speed")
    assert all(check_of(place, variable) for place in Place for variable in VOCABULARY)


def test_a_length_that_is_not_the_logged_one_is_measured():
    assert "by a ruler" in check_of(Place.PARAMETERS, "depth")
    assert "by a ruler" not in check_of(Place.TISSUE, "depth")


def test_every_family_says_a_variable_of_the_vocabulary():
    angle = turns()
    slow = angle - 0.2 * angle**2 / 90
    ranges = covered(angle, tip=slow, torque=0.01 * angle, speed=-1.0, seen=(slow, 0.02 * angle))
    families = families_of(ranges)
    assert {family.says for family in families} <= VOCABULARY
    # Every place but the constants of the rig, which no law is free of, has a family of its own.
    assert {family.place for family in families} == set(Place)
    assert len({family.name for family in families}) == len(families)


def test_what_is_off_by_a_time_is_a_clock_whatever_the_place():
    assert "clocks" in check_of(Place.SENSOR, "time", of_a_clock=True)
    assert "clocks" not in check_of(Place.SENSOR, "time")
