"""Words for places and variables."""

from diagnosis_fixtures import turns
from free_forms import VOCABULARY, covered

from diagnosis.effects.effect import Place
from diagnosis.freeform.families import families_of
from diagnosis.freeform.missing.words import PLACES, VARIABLES


def test_every_place_and_variable_has_words():
    assert set(PLACES) == set(Place)
    assert set(VARIABLES) == VOCABULARY


def test_every_family_says_a_variable_of_the_vocabulary():
    angle = turns()
    slow = angle - 0.2 * angle**2 / 90
    ranges = covered(angle, tip=slow, torque=0.01 * angle, speed=-1.0, seen=(slow, 0.02 * angle))
    families = families_of(ranges)
    assert {family.says for family in families} <= VOCABULARY
    # Every place but the constants of the rig, which no law is free of, has a family of its own.
    assert {family.place for family in families} == set(Place)
    assert len({family.name for family in families}) == len(families)
