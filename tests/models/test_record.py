"""Records: frozen, and with errors that name the field, the value and the fix."""

import math

import pytest

from models.errors import InvalidValue
from models.needle import NITINOL, Needle
from models.record import Record
from models.tissue import Tissue


class Place(Record):
    x_mm: float
    name: str = "somewhere"


def test_a_misspelt_field_is_answered_with_the_right_one():
    with pytest.raises(InvalidValue, match="did you mean 'diameter_mm'"):
        NITINOL.but(diametre_mm=0.5)


def test_a_record_cannot_be_changed():
    with pytest.raises(Exception, match="frozen"):
        NITINOL.diameter_mm = 1.0


def test_a_missing_field_is_named():
    with pytest.raises(InvalidValue, match="density_g_cm3"):
        Needle(diameter_mm=1, shear_modulus_gpa=20)


def test_an_unknown_field_that_resembles_none_is_to_be_removed():
    with pytest.raises(InvalidValue, match=r"one of the fields .*; remove it"):
        NITINOL.but(zzz=1)


def test_the_first_of_several_errors_says_how_many_more_there_are():
    with pytest.raises(InvalidValue, match="and 2 more fields are wrong"):
        Needle(diameter_mm=-1, shear_modulus_gpa=-1, density_g_cm3=-1)


def test_a_copy_is_validated_again_and_leaves_the_original():
    thick = NITINOL.but(diameter_mm=1.27)
    assert (thick.diameter_mm, NITINOL.diameter_mm) == (1.27, 0.59)
    assert thick.but(diameter_mm=0.59) == NITINOL


def test_a_copy_without_a_change_is_the_record_itself():
    assert NITINOL.but(diameter_mm=0.59) is NITINOL
    with pytest.raises(InvalidValue, match="one of the fields"):
        NITINOL.but(diametre_mm=0.59)


def test_an_error_of_a_nested_record_carries_field_value_and_expectation():
    with pytest.raises(InvalidValue) as raised:
        Tissue(layers=[{"interface": {"kinetic_n_mm_per_mm": 2e-3, "static_n_mm_per_mm": 1e-3}}])
    assert raised.value.field == "layers.0.interface.static_n_mm_per_mm"
    assert raised.value.found == 1e-3
    assert raised.value.expected == "at least the kinetic level 0.002"


@pytest.mark.parametrize("bad", [math.nan, math.inf, "far", None])
def test_a_number_has_to_be_finite(bad):
    with pytest.raises(InvalidValue, match=r"^Place\.x_mm: expected a .*number"):
        Place(x_mm=bad)


def test_fields_are_given_by_name_and_numbers_may_be_written_as_text():
    with pytest.raises(TypeError):
        Place(1.0)
    assert Place(x_mm="1.5") == Place(x_mm=1.5, name="somewhere")


@pytest.mark.parametrize(
    ("found", "fix"),
    [
        ("0,59", "write it with a point: 0.59"),
        ("0.59 mm", "in the unit of the field's name: 0.59"),
        ("far", ""),
    ],
)
def test_a_number_that_was_written_otherwise_is_answered_with_how_to_write_it(found, fix):
    with pytest.raises(InvalidValue) as raised:
        Place(x_mm=found)
    assert raised.value.expected == "a number"
    assert fix in raised.value.fix
    assert bool(fix) is bool(raised.value.fix)


def test_a_missing_field_is_looked_for_among_the_names_that_are_not_known():
    with pytest.raises(InvalidValue, match="'x' looks like it: rename it"):
        Place(x=1.0)
    with pytest.raises(InvalidValue, match="this field has no default"):
        Place(speed=1.0)


@pytest.mark.parametrize(("found", "fix"), [(None, "indent its fields"), ("steel", "")])
def test_a_value_in_place_of_fields_is_told_in_plain_words(found, fix):
    class Rig(Record):
        place: Place

    with pytest.raises(InvalidValue, match="expected fields with values, as 'name: value'") as raised:
        Rig(place=found)
    assert fix in raised.value.fix
