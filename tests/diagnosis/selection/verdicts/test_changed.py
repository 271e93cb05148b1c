"""A verdict after what was learned besides."""

from dataclasses import replace

import pytest
from diagnosis_fixtures import scored, verdict_of

from diagnosis.fitting.noise_floor import NoiseFloor
from diagnosis.selection.verdicts.changed import provisional, refuted, with_open_effects
from diagnosis.selection.verdicts.decision import verdict_on
from diagnosis.selection.verdicts.verdict import VerdictKind

TOO_MUCH = NoiseFloor(gap=2.0, slow=5.0)
FAR_BEHIND = scored(["torque_bias"], 500.0)


def cut(*candidates):
    """The provisional verdict on candidates, best first."""
    return provisional(verdict_on(candidates), candidates)


@pytest.mark.parametrize("names", [(), ("tip_drag",), ("tip_drag", "torque_bias")])
def test_what_is_at_the_floor_is_never_said_to_explain_the_log(names):
    best = scored(names, 100.0)
    assert verdict_on([best]).settled
    found = cut(best)
    assert (found.kind, found.effects, found.confusable) == (VerdictKind.UNDECIDED, names, (names,))


def test_every_explanation_at_the_floor_may_be_it_the_best_first():
    found = cut(scored(["tip_drag"], 100.0), scored(["entry_friction"], 300.0), FAR_BEHIND)
    assert found.confusable == (("tip_drag",), ("entry_friction",), ("torque_bias",))


def test_an_explanation_above_the_floor_is_no_rival():
    found = cut(scored(["tip_drag"], 100.0), scored(["entry_friction"], 200.0, floor=TOO_MUCH))
    assert found.confusable == (("tip_drag",),)


def test_the_same_effects_in_another_order_are_one_set():
    one, other = scored(["tip_drag", "torque_bias"], 100.0), scored(["torque_bias", "tip_drag"], 200.0)
    assert cut(one, other).confusable == (("tip_drag", "torque_bias"),)


def test_nothing_at_the_floor_stays_unknown():
    assert cut(scored(["tip_drag"], 100.0, floor=TOO_MUCH)).kind is VerdictKind.UNKNOWN


def test_what_cannot_be_told_apart_stays_beside_a_provisional_verdict():
    best = scored(["tip_drag"], 100.0)
    found = replace(verdict_on([best]), confusable=(("tip_drag",), ("torque_bias", "entry_friction")))
    assert provisional(found, [best]).confusable == (("tip_drag",), ("torque_bias", "entry_friction"))


def test_an_explanation_that_is_refuted_is_unknown_and_stays_the_best():
    found = verdict_of((["layered_tissue"], 100.0), (["tip_drag"], 200.0))
    assert found.kind is VerdictKind.EXPLAINED
    changed = refuted(found, "damping that changes along the shaft")
    assert (changed.kind, changed.effects) == (VerdictKind.UNKNOWN, ())
    assert changed.best is found.best
    assert dict(changed.ranking)["unknown",] == 1.0
    assert changed.other_form == "damping that changes along the shaft"


def test_an_effect_that_may_be_hidden_leaves_the_verdict_open_with_half_of_the_probability_each():
    explained = verdict_of((["tip_drag"], 100.0))
    found = with_open_effects(explained, ["torque_bias"])
    assert found.kind is VerdictKind.UNDECIDED
    assert found.confusable == (("tip_drag",), ("tip_drag", "torque_bias"))
    ranking = dict(found.ranking)
    assert ranking["tip_drag",] == ranking["tip_drag", "torque_bias"] == pytest.approx(0.5)
    assert sum(ranking.values()) == pytest.approx(1.0)
    assert with_open_effects(explained, []) is explained


def test_beside_the_nominal_rig_the_hidden_effect_would_be_the_only_one():
    found = with_open_effects(verdict_of(([], 100.0)), ["torque_bias"])
    assert found.confusable == ((), ("torque_bias",))
    assert dict(found.ranking)["torque_bias",] == pytest.approx(0.5)


def test_nothing_is_hidden_where_nothing_explains_the_log():
    above = verdict_on([scored(["tip_drag"], 90.0, floor=NoiseFloor(gap=2.0, slow=5.0))])
    assert with_open_effects(above, ["torque_bias"]) is above
