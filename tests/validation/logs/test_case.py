"""Validation cases: effects whose signatures are as asked for, and draws that are rejected."""

import numpy as np
import pytest

from validation.logs.case import DRAWS, LEAST_UNMODELLED, MOST_UNMODELLED, ImpossibleDraw, draw_case


def drawn(kind, names, signature=(1.5, 20.0)):
    return draw_case(np.random.default_rng(4), kind, names, short=True, signature=signature)


@pytest.mark.parametrize(
    ("kind", "names"),
    [("single", ("tip_angle_scale",)), ("pair", ("coulomb_friction", "torque_bias")), ("none", ())],
)
def test_a_case_has_the_effects_and_the_signatures_that_were_asked_for(kind, names):
    case = drawn(kind, names)
    assert set(case.signatures) == set(case.rig.effects) == set(names)
    assert all(1.5 <= value <= 20.0 for value in case.signatures.values())
    assert len(case.motions) == len(case.signals) == case.plan.trials
    assert case.gap >= 1.0
    assert (case.gap == 1.0) is (kind == "none")


def test_an_unmodelled_effect_is_seen_and_explained_by_no_modelled_pair():
    case = drawn("outside", ("torque_drift",), (0.5, 1.0))
    assert LEAST_UNMODELLED <= case.signatures["torque_drift"] <= MOST_UNMODELLED
    assert case.alternatives.pair_residual >= 0.7
    assert min(case.alternatives.alone.values()) >= 0.7


def test_a_range_that_no_draw_reaches_is_named(monkeypatch):
    monkeypatch.setattr("validation.logs.case.DRAWS", 2)
    assert DRAWS > 2
    with pytest.raises(
        ImpossibleDraw, match=r"signature: .*single with tip_angle_bias.*found \(1000000\.0"
    ):
        drawn("single", ("tip_angle_bias",), (1e6, 2e6))
