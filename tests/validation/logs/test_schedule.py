"""Which log has which kind and effects: fixed shares, every effect in turn, fixed by the seed."""

import pytest

from validation.logs.roughness.recording import PAIRS
from validation.logs.roughness.wrong import FAULTS
from validation.logs.schedule import (
    KINDS,
    LOCATIONS,
    MUTUALLY_EXCLUSIVE,
    PARAMETER_ERRORS,
    effects_of,
    kind_of,
    name_in_turn,
    roughness_of,
)
from validation.rig.modelled import MODELLED, WRONG_CONSTANTS
from validation.rig.unmodelled.library import UNLISTED, UNMODELLED


def test_shares_of_kinds_are_kept():
    kinds = [kind_of(9, i)[0] for i in range(330)]
    counts = {kind: kinds.count(kind) for kind in KINDS}
    assert counts == {"none": 40, "single": 150, "pair": 60, "off_nominal": 40, "outside": 40}


def test_logs_of_a_kind_are_counted_in_their_order():
    seen = [kind_of(9, i) for i in range(80)]
    for kind in KINDS:
        earlier = [before for k, before in seen if k == kind]
        assert earlier == list(range(len(earlier)))


def test_only_kinds_that_were_asked_for_are_drawn():
    assert all(kind_of(9, i, ["single", "none"])[0] in ("single", "none") for i in range(40))


def test_effects_take_turns():
    singles = [effects_of(9, "single", earlier, None)[0] for earlier in range(38)]
    assert sorted(singles) == sorted(2 * MODELLED)
    assert sorted(name_in_turn(9, i, "abc") for i in range(3)) == ["a", "b", "c"]


@pytest.mark.parametrize("earlier", range(40))
def test_a_pair_is_of_two_effects_that_can_be_told_apart(earlier):
    first, second = effects_of(5, "pair", earlier, None)
    assert first != second
    assert not any({first, second} <= names for names in MUTUALLY_EXCLUSIVE)


@pytest.mark.parametrize("earlier", range(40))
def test_three_effects_can_be_told_apart_and_begin_with_each_in_turn(earlier):
    names = effects_of(5, "triple", earlier, None)
    assert len({*names}) == 3
    assert names[:2] == effects_of(5, "pair", earlier, None)
    assert not any(len({*names} & excluded) > 1 for excluded in MUTUALLY_EXCLUSIVE)


def test_most_pairs_are_of_two_locations():
    """15 % are asked to share one: of 200, 48 or more would have a probability below 0.1 %."""
    pairs = [effects_of(5, "pair", earlier, None) for earlier in range(200)]
    together = sum(LOCATIONS[a] == LOCATIONS[b] for a, b in pairs)
    assert 0 < together < 48


def test_rough_logs_take_pairs_of_roughnesses_in_turn_or_what_is_asked_for():
    pairs = [roughness_of(5, "rough_single", i, i, None) for i in range(len(PAIRS))]
    assert sorted(pairs) == sorted(PAIRS)
    asked = ("outliers", "late_start")
    alone = [roughness_of(5, "rough_none", 0, i, asked) for i in range(3)]
    assert alone == [("outliers",), ("late_start",), ("outliers",)]
    assert roughness_of(5, "single", 0, 0, asked) == ()


def test_wrong_constants_are_drawn_where_they_are_asked_for():
    assert {effects_of(5, "wrong_constant", i, None)[0] for i in range(5)} == {*WRONG_CONSTANTS}
    for kind in ("single", "pair", "off_nominal", "rough_single"):
        assert effects_of(5, kind, 3, ["torque_scale"])[0] == "torque_scale"
        assert not {*effects_of(5, kind, 3, None)} & {*WRONG_CONSTANTS}


def test_what_is_wrong_outside_the_library_is_a_constant_or_the_recording():
    drawn = [
        effects_of(5, "wrong_outside", i, None) + roughness_of(5, "wrong_outside", i, i, None)
        for i in range(4)
    ]
    assert sorted(drawn) == sorted((name,) for name in (*UNLISTED, *FAULTS))


def test_kinds_have_the_effects_that_they_stand_for():
    assert effects_of(5, "none", 3, None) == ()
    drawn = {effects_of(5, "outside", i, None)[0] for i in range(len(UNMODELLED))}
    assert drawn == {*UNMODELLED}
    off_nominal = {effects_of(5, "off_nominal", i, None)[0] for i in range(34)}
    assert off_nominal == {*MODELLED} - {*PARAMETER_ERRORS}
    assert effects_of(5, "single", 3, ["tip_drag"]) == ("tip_drag",)
