"""What to change where an effect is found."""

import numpy as np
import pytest
from diagnosis_fixtures import RIG

from diagnosis.assessment.advice.remedies import check_that_tells, in_words, remedies
from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.effects import LIBRARY


def value(number, unit):
    return Interval(value=number, low=number, high=number, unit=unit)


def fitted(effect):
    """Values of every reported parameter of an effect."""
    return {effect.name: {p.name: value(p.start[0], p.unit) for p in effect.reported}}


@pytest.mark.parametrize(
    ("effect", "parameters", "said"),
    [
        (
            "coulomb_friction",
            {"level": value(0.0015, "N mm / mm")},
            "add dry friction of 0.0015 N mm / mm along the inserted shaft to the model",
        ),
        (
            "torque_scale",
            {"scale": value(1.1, "-")},
            "calibrate the torque sensor: divide its readings by 1.1",
        ),
        (
            "damping_error",
            {"scale": value(1.25, "-")},
            "set tissue.damping_n_mm_s_per_mm in rig.yaml to 0.0215",  # 1.25 of 0.0172
        ),
        (
            "stiffness_error",
            {"scale": value(0.5, "-")},
            "set needle.shear_modulus_gpa in rig.yaml to 13.6",
        ),
        (
            "tip_angle_bias",
            {"bias": value(2.5, "deg")},
            "subtract 2.5 deg from the readings of the tip sensor",
        ),
    ],
)
def test_a_remedy_names_what_to_change_and_the_value(effect, parameters, said):
    assert remedies((effect,), {effect: parameters}, RIG) == said


@pytest.mark.parametrize("effect", LIBRARY.values(), ids=lambda e: e.name)
def test_every_effect_has_a_remedy_with_all_its_values_and_a_check(effect):
    parameters = fitted(effect)
    said = remedies((effect.name,), parameters, RIG)
    assert effect.title not in said  # which is said of an effect without words of its own
    assert "{" not in said
    if not effect.corrects:
        assert all(in_words(p) in said for p in parameters[effect.name].values())
    assert len(effect.check.split()) > 5


def test_a_spring_in_the_drive_is_told_with_the_longer_free_shaft_that_does_the_same():
    """Twist of a free shaft: torque * length / (G pi d^4 / 32)."""
    rigidity = 1e3 * RIG.needle.shear_modulus_gpa * np.pi * RIG.needle.diameter_mm**4 / 32
    spring = {"base_compliance": {"stiffness": value(rigidity / 36.0, "N mm / rad")}}
    said = remedies(("base_compliance",), spring, RIG)
    assert "a free shaft that is 36 mm longer than logged would do the same" in said


def test_of_several_effects_each_has_its_remedy():
    both = fitted(LIBRARY["tip_drag"]) | fitted(LIBRARY["torque_bias"])
    said = remedies(("torque_bias", "tip_drag"), both, RIG)
    assert [part.split()[0] for part in said.split("; ")] == ["subtract", "add"]


def test_a_value_that_is_missing_leaves_the_title():
    assert remedies(("tip_drag",), {}, RIG) == "put into the model: viscous drag at the tip"


def test_what_tells_sets_apart_is_the_calibration_of_a_sensor_that_one_of_them_has():
    sets = [("stiffness_error", "damping_error"), ("torque_scale",)]
    assert check_that_tells(sets) == LIBRARY["torque_scale"].check
    assert check_that_tells([("tip_drag",), ("damping_error",)]) == LIBRARY["damping_error"].check
    both = [("torque_scale", "tip_drag"), ("torque_scale", "entry_friction")]
    assert check_that_tells(both) == LIBRARY["tip_drag"].check
    assert check_that_tells([]) == ""
