"""Probabilities of all explanations."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import scored, verdict_of

from diagnosis.criteria.selection import LATE_LEAD, SIMPLE_LEAD
from diagnosis.effects import LIBRARY
from diagnosis.fitting.noise_floor import NoiseFloor
from diagnosis.selection.verdicts.decision import verdict_on
from diagnosis.selection.verdicts.ranking import NOTHING, UNEXPLAINED, ranking_of
from diagnosis.selection.verdicts.verdict import VerdictKind


def test_a_ranking_is_of_what_explains_the_log():
    above = scored(["tip_drag"], 90.0, floor=NoiseFloor(gap=2.0, slow=5.0))
    found = verdict_on([above, scored(["entry_friction"], 100.0), scored(["stiction"], 104.0)])
    ranking = dict(found.ranking)
    assert ranking["tip_drag",] == 0.0
    assert ranking["entry_friction",] == pytest.approx(1 / (1 + np.exp(-2)))


def test_probabilities_are_those_of_the_scores():
    ranking = dict(verdict_of((["tip_drag"], 100.0), (["entry_friction"], 104.0)).ranking)
    assert sum(ranking.values()) == pytest.approx(1.0)
    assert ranking["tip_drag",] / ranking["entry_friction",] == pytest.approx(2.718281828**2)
    assert set(ranking) == {(name,) for name in (*LIBRARY, "none", "unknown")}


def test_a_pair_is_one_row_of_the_ranking_at_its_own_probability():
    first, second = (["tip_drag", "torque_bias"], 100.0), (["torque_bias", "tip_drag"], 103.0)
    found = verdict_of(first, second, (["entry_friction"], 104.0))
    ranking = dict(found.ranking)
    assert sum(ranking.values()) == pytest.approx(1.0)
    pair = ranking["tip_drag", "torque_bias"]
    odds = np.exp(2.0) * (1.0 + np.exp(-1.5))  # of both fits of the pair
    assert pair / ranking["entry_friction",] == pytest.approx(odds)
    assert ranking["tip_drag",] == ranking["torque_bias",] == 0.0


def test_one_more_effect_has_the_lead_that_it_needs_against_it():
    """Else what the verdict names would be the less probable."""
    richer = (["tip_drag", "torque_bias"], 100.0)
    found = verdict_of(richer, (["tip_drag"], 104.0), (["entry_friction"], 110.0))
    assert found.effects == ("tip_drag",)
    ranking = dict(found.ranking)
    odds = ranking["tip_drag",] / ranking["tip_drag", "torque_bias"]
    assert odds == pytest.approx(np.exp(0.5 * (SIMPLE_LEAD - 4.0)))
    assert ranking["tip_drag",] / ranking["entry_friction",] == pytest.approx(np.exp(3.0))


def test_of_what_leads_by_enough_the_score_alone_counts():
    found = verdict_of((["tip_drag", "torque_bias"], 100.0), (["tip_drag"], 112.0))
    assert found.effects == ("tip_drag", "torque_bias")
    ranking = dict(found.ranking)
    assert ranking["tip_drag", "torque_bias"] / ranking["tip_drag",] == pytest.approx(np.exp(6.0))


def test_of_trials_that_began_late_the_certain_part_of_a_lead_counts():
    """As in the verdict; else what is undecided would have odds of thousands to one."""
    first, second = scored(["tip_drag"], 100.0), scored(["entry_friction"], 117.0)
    early = dict(verdict_on([first, second]).ranking)
    assert early["tip_drag",] / early["entry_friction",] == pytest.approx(np.exp(8.5))
    late = verdict_on([replace(one, begun_late=True) for one in (first, second)])
    assert late.kind is VerdictKind.UNDECIDED
    ranking = dict(late.ranking)
    odds = ranking["tip_drag",] / ranking["entry_friction",]
    assert odds == pytest.approx(np.exp(0.5 * (17.0 - LATE_LEAD)))


def test_an_effect_has_no_such_lead_against_it_where_nothing_is_named():
    """Nothing is the answer only where it is the likeliest one."""
    found = verdict_of(([], 100.0), (["tip_drag"], 103.0))
    assert found.effects == ()
    ranking = dict(found.ranking)
    assert ranking[NOTHING,] / ranking["tip_drag",] == pytest.approx(np.exp(1.5))


def test_where_nothing_is_known_all_of_it_is_unknown():
    shares = dict(ranking_of([], None))
    assert shares.pop((UNEXPLAINED,)) == 1.0
    assert set(shares) == {(name,) for name in (*LIBRARY, NOTHING)}
    assert set(shares.values()) == {0.0}
