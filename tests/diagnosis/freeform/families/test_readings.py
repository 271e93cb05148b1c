"""Free laws that add to an angle or a reading."""

import numpy as np
import pytest
from diagnosis_fixtures import RIG, turns
from free_forms import covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Place
from diagnosis.freeform.families.readings import families
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
LATE, TORQUE = 0.8 * ANGLE, 0.01 * ANGLE
RANGES = covered(ANGLE, tip=LATE + 2.0, torque=TORQUE + 0.3, seen=(LATE, TORQUE))
FAMILIES = {family.name: family for family in families(RANGES)}
CONSTANT = {"tip reading": ("tip_angle_bias", 1.5), "torque reading": ("torque_bias", 0.2)}


def rig_of(name, *values):
    family = FAMILIES[name]
    flat = [0.0] * (len(family.effect.parameters) - len(values))
    return family.effect.apply(NOMINAL, *values, *flat)


@pytest.mark.parametrize("name", list(FAMILIES))
def test_a_curve_of_nothing_is_the_nominal_rig(name):
    assert rig_of(name).free is not None
    assert same_readings(ANGLE, rig_of(name), NOMINAL)


@pytest.mark.parametrize("variable", ["time", "tip_angle", "direction"])
def test_a_constant_error_of_the_tip_sensor_is_its_bias(variable):
    bias = LIBRARY["tip_angle_bias"].apply(NOMINAL, 1.5)
    assert same_readings(ANGLE, rig_of(f"tip reading over {variable}", 1.5), bias)


@pytest.mark.parametrize("name", ["torque reading over time", "drive torque over rate"])
def test_a_constant_error_of_the_torque_is_its_bias(name):
    bias = LIBRARY["torque_bias"].apply(NOMINAL, 0.2)
    assert same_readings(ANGLE, rig_of(name, 0.2), bias)


def test_an_offset_of_the_drive_turns_the_whole_needle():
    """Held off by as much throughout, it starts untwisted there: the tip is off by as much."""
    bias = LIBRARY["tip_angle_bias"].apply(NOMINAL, 3.0)
    assert same_readings(ANGLE, rig_of("drive angle over time", 3.0), bias)


def test_an_angle_of_the_drive_shows_in_the_torque_where_the_tip_is_not_measured():
    """Its scale is the twist of the nominal shaft under the torque that is missing."""
    ranges = covered(ANGLE, torque=TORQUE + 0.3, seen=(LATE, TORQUE))
    assert set(ranges.missing) == {"base_torque_n_mm"}
    found = {family.name: family for family in families(ranges)}
    assert {"drive angle over time", "drive slip over torque"} <= set(found)
    assert not any(name.startswith("tip reading") for name in found)
    assert found["drive angle over time"].unit == "deg"
    level = found["drive angle over time"].effect.parameters[0]
    alone = FAMILIES["drive angle over time"].effect.parameters[0]
    trial = ranges.problem.log.trials[0]
    twist_rad = 0.3 * (trial.free_mm + trial.inserted_mm).max() / RIG.rigidity_n_mm2
    # Beside the tip it is what that misses: 2 deg.
    assert level.high / alone.high == pytest.approx(np.degrees(twist_rad) / 2.0)


def test_an_angle_of_a_drive_that_never_turns_has_a_scale():
    still = np.zeros(ANGLE.size)
    found = families(covered(still, torque=still + 0.3, seen=(still, still)))
    assert "drive angle over time" in {family.name for family in found}
    assert all(np.isfinite(p.high) for family in found for p in family.effect.parameters)


def test_what_repeats_says_after_how_much():
    names = [name for name in FAMILIES if ", every 360 deg" in name]
    assert sorted(names) == [
        f"{what}, every 360 deg"
        for what in (
            "drive angle over base_angle",
            "drive torque over base_angle",
            "tip reading over base_angle",
            "tip reading over tip_angle",
            "torque reading over tip_angle",
        )
    ]


def test_a_sensor_that_was_not_read_has_no_law():
    names = {family.name for family in families(covered(ANGLE, tip=ANGLE))}
    assert names
    assert not any("torque reading" in name or "drive torque" in name for name in names)


def test_an_offset_over_the_torque_is_more_likely_a_twist_of_the_needle():
    assert FAMILIES["tip reading over torque"].place is Place.NEEDLE
    assert FAMILIES["torque reading over torque"].place is Place.SENSOR
    units = {name: family.unit for name, family in FAMILIES.items()}
    assert units["torque reading over torque"] == "N mm"
    assert units["tip reading over past"] == "-"
    over_time = FAMILIES["tip reading over time"]
    assert np.isfinite(over_time.curve(*[0.0] * len(over_time.effect.parameters))[1]).all()


def test_a_gain_that_does_not_change_is_a_wrong_gain():
    for name, scale in (("tip", "tip_angle_scale"), ("torque", "torque_scale")):
        gained = LIBRARY[scale].apply(NOMINAL, 1.1)
        assert same_readings(ANGLE, rig_of(f"{name} gain over time", np.log(1.1)), gained)
        _, factors = FAMILIES[f"{name} gain over time"].curve(np.log(1.1), *[0.0] * 11)
        np.testing.assert_allclose(factors, 1.1)


@pytest.mark.parametrize("more", ["", ", every 360 deg"])
def test_an_angle_that_errs_with_itself_is_of_the_encoder_or_of_the_drive(more):
    places = FAMILIES[f"drive angle over base_angle{more}"].places
    assert set(places) == {Place.SENSOR, Place.DRIVE}
    assert min(places.values()) > 0.4


def test_several_waves_a_turn_are_of_the_drive():
    ripple = [f for name, f in FAMILIES.items() if name.startswith("drive angle over base_angle, every")]
    assert [f.places for f in ripple if "360" not in f.name] == [{Place.DRIVE: 1.0}]
