"""The names of the modelled effects: those of the diagnosis, each with a place in the rig."""

from diagnosis.effects import LIBRARY
from validation.rig.laws.parameters import LawParameters
from validation.rig.modelled import (
    LAW_FIELDS,
    MODELLED,
    SENSOR_FIELDS,
    WRONG_CONSTANT_FIELDS,
    WRONG_CONSTANTS,
)


def test_the_rig_has_the_effects_and_parameters_of_the_library():
    """But for what is no part of the vocabulary: the diagnosis fits it, the rig fixes it."""
    every = LAW_FIELDS | SENSOR_FIELDS | WRONG_CONSTANT_FIELDS
    fields = {name: {*own} for name, own in every.items()}
    assert fields == {name: {p.name for p in effect.reported} for name, effect in LIBRARY.items()}
    assert sorted((*MODELLED, *WRONG_CONSTANTS)) == sorted(fields)


def test_every_parameter_of_the_machine_goes_to_a_field_of_its_own():
    targets = [target for fields in LAW_FIELDS.values() for target in fields.values()]
    assert len(targets) == len({*targets})
    assert {*targets} <= {*LawParameters._fields}
