"""A slice of `make fuzz`: inputs end in an error that names them, a warning, or a right answer."""

import pytest
from fuzz import logs, protocols
from fuzz.families import FAMILIES, each_input
from fuzz.outcome import Kind, outcome

from models.errors import InvalidValue

SLICE = 300  # inputs of all families


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name", FAMILIES)
def test_every_input_ends_as_it_should(name):
    family = FAMILIES[name]
    total = sum(family.weight for family in FAMILIES.values())

    def check(value):
        result = family.checked(value)
        assert result.kind is not Kind.FAULT, f"{value!r:.2000}\n{result.said}"

    each_input(family, check, most=max(3, SLICE * family.weight // total))


def test_the_good_inputs_are_read():
    assert logs.checked(logs.GOOD, same=True).kind is not Kind.FAULT
    assert protocols.checked(protocols.GOOD.encode(), same=True).kind is Kind.RIGHT


def raising(error):
    def action():
        raise error

    return action


@pytest.mark.parametrize(
    ("action", "same"),
    [
        (raising(KeyError("x")), False),
        (raising(MemoryError()), False),
        (raising(InvalidValue("field", 1, "2")), False),
        (raising(InvalidValue("file", 1, "2")), True),
        (lambda: ["another warning"], True),
    ],
)
def test_what_should_not_be_is_a_fault(action, same):
    """Negative control of the oracle."""
    assert outcome(action, names=["file"], same=same).kind is Kind.FAULT


def test_an_input_that_takes_too_much_memory_is_a_fault():
    found = outcome(lambda: [str(len(bytearray(10**11)))], names=[], same=False)
    assert found.kind is Kind.FAULT
    assert "MemoryError" in found.said
