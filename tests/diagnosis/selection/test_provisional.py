"""What is concluded from a search that was cut short."""

import pytest
from diagnosis_fixtures import scored

from diagnosis.fitting.noise_floor import NoiseFloor
from diagnosis.selection.provisional import provisional
from diagnosis.selection.verdict import VerdictKind, verdict_on

ABOVE = NoiseFloor(gap=2.0, slow=5.0)
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
    found = cut(scored(["tip_drag"], 100.0), scored(["entry_friction"], 200.0, floor=ABOVE))
    assert found.confusable == (("tip_drag",),)


def test_the_same_effects_in_another_order_are_one_set():
    one, other = scored(["tip_drag", "torque_bias"], 100.0), scored(["torque_bias", "tip_drag"], 200.0)
    assert cut(one, other).confusable == (("tip_drag", "torque_bias"),)


def test_nothing_at_the_floor_stays_unknown():
    assert cut(scored(["tip_drag"], 100.0, floor=ABOVE)).kind is VerdictKind.UNKNOWN
