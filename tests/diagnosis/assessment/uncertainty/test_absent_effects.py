"""Effects whose intervals reach the value of no effect."""

from dataclasses import replace

import pytest
from diagnosis_fixtures import scored

from diagnosis.assessment.uncertainty.absent_effects import without_absent
from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.selection.verdicts.decision import verdict_on
from diagnosis.selection.verdicts.verdict import VerdictKind


def between(low, high):
    return Interval(value=0.5 * (low + high), low=low, high=high, unit="")


SAMPLE_S = 0.01
FRICTION = {"level": between(0.001, 0.002)}
BIAS = {"bias": between(1.0, 2.0)}
ABSENT = {
    "tip_sensor_delay": {"delay": between(1e-4, 3e-4)},  # of a sample of 10 ms
    "torque_bias": {"bias": between(-0.1, 0.2)},
    "tip_angle_scale": {"scale": between(0.99, 1.01)},
    "coulomb_friction": {"level": between(0.0, 1e-4)},
    "base_compliance": {"stiffness": between(1e3, 1e12)},
}


def verdict(*names):
    return verdict_on([scored(names, 100.0)])


@pytest.mark.parametrize(
    ("refused", "kind", "more"),
    [
        (set(), VerdictKind.UNDECIDED, (("torque_sensor_delay",),)),
        ({frozenset({"torque_sensor_delay"})}, VerdictKind.NONE, ()),
    ],
    ids=["that was not tried", "which explains nothing"],
)
def test_a_filter_of_which_nothing_else_is_left_may_be_a_delay(refused, kind, more):
    filtered = verdict("torque_low_pass", "torque_bias")
    found = without_absent(filtered, {"torque_bias": ABSENT["torque_bias"]}, SAMPLE_S, refused)
    assert (found.kind, found.effects) == (kind, ())
    assert found.confusable == ((), ("torque_bias",), *more)


@pytest.mark.parametrize("name", ABSENT)
def test_an_effect_that_may_as_well_be_absent_is_told_only_beside_the_others(name):
    both = verdict("tip_angle_bias", name)
    found = without_absent(both, {"tip_angle_bias": BIAS, name: ABSENT[name]}, SAMPLE_S)
    assert (found.kind, found.effects) == (VerdictKind.EXPLAINED, ("tip_angle_bias",))
    assert found.confusable == (("tip_angle_bias",), both.effects)
    assert found.ranking[0] == (("tip_angle_bias",), 1.0)


def test_nothing_is_there_where_all_effects_may_as_well_be_absent():
    found = without_absent(verdict("torque_bias"), {"torque_bias": ABSENT["torque_bias"]}, SAMPLE_S)
    assert (found.kind, found.effects) == (VerdictKind.NONE, ())


@pytest.mark.parametrize(
    ("name", "own"),
    [
        ("coulomb_friction", FRICTION),
        ("torque_bias", {"bias": between(0.01, 0.2)}),
        ("tip_angle_scale", {"scale": between(1.001, 1.01)}),
        ("base_compliance", {"stiffness": between(100.0, 200.0)}),
        ("tip_sensor_delay", {"delay": between(0.002, 0.004)}),
        ("stiction", {"kinetic": between(0.0, 1e-3), "static": between(1e-3, 2e-3)}),
    ],
)
def test_an_effect_whose_strength_is_certain_stays(name, own):
    one = verdict(name)
    assert without_absent(one, {name: own}, SAMPLE_S) is one


def test_where_the_rest_was_refused_it_is_open():
    both = verdict("tip_angle_bias", "torque_bias")
    intervals = {"tip_angle_bias": BIAS, "torque_bias": ABSENT["torque_bias"]}
    refused = {frozenset({"tip_angle_bias"})}
    found = without_absent(both, intervals, SAMPLE_S, refused)
    assert (found.kind, found.effects) == (VerdictKind.UNDECIDED, ("tip_angle_bias",))
    assert found.confusable == (("tip_angle_bias",), both.effects)


@pytest.mark.parametrize(
    ("others", "refused", "kind"),
    [
        ([], set(), VerdictKind.NONE),
        ([], {frozenset()}, VerdictKind.UNDECIDED),
        ([("tip_drag",)], set(), VerdictKind.UNDECIDED),
    ],
    ids=["its absence alone", "which was refused", "another effect as well"],
)
def test_what_was_open_only_between_an_effect_and_its_absence_is_decided(others, refused, kind):
    one = verdict("torque_bias")
    one = replace(one, kind=VerdictKind.UNDECIDED, confusable=(one.effects, (), *others))
    found = without_absent(one, {"torque_bias": ABSENT["torque_bias"]}, SAMPLE_S, refused)
    assert (found.kind, found.effects) == (kind, ())
    assert found.confusable == ((), ("torque_bias",), *others)
