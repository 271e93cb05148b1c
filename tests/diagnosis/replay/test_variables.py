"""What a free law may depend on: every variable has a unit, and a word of the vocabulary."""

from free_forms import VOCABULARY

from diagnosis.replay.variables import SAYS, UNITS, Variable


def test_every_variable_has_a_unit():
    assert set(UNITS) == set(Variable)
    assert all(UNITS.values())


def test_every_variable_has_one_word_of_the_vocabulary():
    own = {variable for variable in Variable if variable in VOCABULARY}
    assert own.isdisjoint(SAYS)
    assert own | set(SAYS) == set(Variable)
    assert set(SAYS.values()) <= VOCABULARY
