"""What is known of the effects outside the diagnosis: what they change, where, on what they depend."""

import pytest

from validation.rig.unmodelled.effect import PLACES, VARIABLES
from validation.rig.unmodelled.library import EFFECTS, UNLISTED, UNLISTED_CONSTANTS, UNMODELLED

EVERY = EFFECTS | UNLISTED_CONSTANTS


def test_there_are_many_and_each_place_has_some():
    assert len(UNMODELLED) >= 24
    assert not {*UNMODELLED} & {*UNLISTED}
    for place in PLACES:
        own = [name for name, effect in EVERY.items() if effect.place[0] == place]
        assert len(own) >= (2 if place == "parameters" else 4), place


def test_every_variable_leads_for_some_effect_but_those_that_no_law_has_alone():
    """The depth matters where the position does; what depends on it alone is not among them."""
    assert {effect.variables[0] for effect in EVERY.values()} == {*VARIABLES} - {"depth"}


@pytest.mark.parametrize("name", EVERY)
def test_an_effect_has_known_places_and_variables_and_few_of_them(name):
    effect = EVERY[name]
    assert {*effect.place} <= {*PLACES}
    assert {*effect.variables} <= {*VARIABLES}
    assert 1 <= len({*effect.place}) == len(effect.place) <= 2
    assert 1 <= len({*effect.variables}) == len(effect.variables) <= 2


@pytest.mark.parametrize("name", UNMODELLED)
def test_an_effect_changes_the_law_the_drive_or_the_signals(name):
    effect = EFFECTS[name]
    assert sum(change is not None for change in (effect.law, effect.drive, effect.signals)) == 1
