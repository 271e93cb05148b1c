"""Which sets of effects are fitted, and why others are not."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import FITTED_SAMPLES, NO_LOG, fit_of, scored

from diagnosis.criteria.selection import (
    CONTENDING,
    EQUAL_SCORE,
    FINALISTS,
    MOST_FINALISTS,
    NEAR_FLOOR,
    SIMPLE_LEAD,
    SLOPES_OF_ITS_OWN,
)
from diagnosis.effects import LIBRARY
from diagnosis.fitting.fit_status import FitStatus, Termination
from diagnosis.fitting.noise_floor import NoiseFloor
from diagnosis.fitting.problem import FitProblem
from diagnosis.replay.resolution import FINE
from diagnosis.selection import fitting
from diagnosis.selection.fitting import fit_all, fit_beside, fit_finalists, in_question
from diagnosis.selection.record import Decision
from diagnosis.workers import Workers


def decisions(record):
    return {(e.effects, e.decision): e for e in record}


def test_finalists_are_the_best_within_reach(made):
    names = ("tip_drag", "stiction", "torque_bias", "tip_angle_bias", "tip_angle_scale")
    near = [scored([n], 100.0 + 1.1 * SIMPLE_LEAD * i) for i, n in enumerate(names)]
    far = scored(["entry_friction"], 101.0 + CONTENDING)
    found, record = fit_finalists("finalists", NO_LOG, [*near, far], Workers())
    assert len(found) == FINALISTS == 4
    assert made == [c.names for c in near[:FINALISTS]]
    out = {e.effects: e.reason for e in record if e.decision is Decision.DROPPED}
    assert "4 others are better" in out["tip_angle_scale",]
    assert "by more than 60" in out["entry_friction",]


def test_where_many_fit_about_as_well_more_are_finalists(made):
    alike = [scored([name], 100.0 + 0.1 * i) for i, name in enumerate(list(LIBRARY)[:12])]
    fit_finalists("finalists", NO_LOG, alike[:6], Workers())
    assert len(made) == 6
    made.clear()
    fit_finalists("finalists", NO_LOG, alike, Workers())
    assert len(made) == MOST_FINALISTS


def test_what_ties_with_the_last_finalist_is_one_too(made):
    """Where a needle never slides two laws of dry friction are one, and either may be the answer."""
    scores = {"tip_drag": 0.0, "entry_friction": 1.0, "torque_bias": 2.0}
    scores |= {"speed_dependent_friction": 50.0, "coulomb_friction": 50.0 + 0.5 * EQUAL_SCORE}
    ranked = [scored([name], 100.0 + score) for name, score in scores.items()]
    apart = scored(["stiction"], 150.0 + 2.0 * EQUAL_SCORE)
    fit_finalists("finalists", NO_LOG, [*ranked, apart], Workers())
    assert made == [(name,) for name in scores]


def test_a_finalist_that_stays_far_above_the_noise_is_given_up(made, monkeypatch):
    monkeypatch.setattr(FitProblem, "samples", FITTED_SAMPLES)
    fit_finalists("finalists", NO_LOG, [scored(["tip_drag"], 1.0)], Workers())
    assert made.allowed == [NEAR_FLOOR * FITTED_SAMPLES]


def test_no_contender_is_no_finalist(made):
    assert fit_finalists("finalists", NO_LOG, [], Workers()) == ([], ())


def test_each_effect_of_a_candidate_is_fitted_alone_from_where_it_is(made):
    pair = scored(["tip_drag", "torque_bias"], 1.0)
    found, record = fit_beside("alone", NO_LOG, pair, [(n,) for n in pair.names], Workers())
    assert [c.names for c in found] == [("tip_drag",), ("torque_bias",)]
    assert [c.fit.cost for c in found] == [float(pair.fit.parts[n][0]) for n in pair.names]
    assert {e.stage for e in record} == {"alone"}
    assert made.allowed == [pair.score + CONTENDING] * 2


def test_calls_come_back_in_their_order(made):
    calls = [(NO_LOG, (n,), np.array([c])) for n, c in (("tip_drag", 3.0), ("stiction", 1.0))]
    found, _ = fit_all("any", calls, Workers())
    assert [c.fit.cost for c in found] == [3.0, 1.0]


@pytest.mark.parametrize(
    ("gap", "termination", "decimated", "goes"),
    [
        (0.99 * SLOPES_OF_ITS_OWN, Termination.OFFSET, False, [(True, False), (False, True)]),
        (1.01 * SLOPES_OF_ITS_OWN, Termination.OFFSET, False, [(True, False)]),
        (1.0, Termination.BEHIND, False, [(True, False)]),
        (1.0, Termination.OFFSET, True, [(False, False)]),
    ],
)
def test_slopes_are_of_half_as_fine_runs_until_a_fit_to_the_log_comes_near_the_noise(
    gap, termination, decimated, goes, monkeypatch
):
    seen = []

    def fit_effects(problem, names, start, enough, *, from_a_fit=False):
        seen.append((problem.differences_halved, from_a_fit))
        status = FitStatus(termination=termination, message="ended")
        return fit_of(names, by_trial=[np.full(FITTED_SAMPLES, gap)], status=status)

    monkeypatch.setattr(fitting, "fit_effects", fit_effects)
    fitting.fit_in_turn(replace(NO_LOG, callback_alone=decimated), ("tip_drag",), np.zeros(1))
    assert seen == goes


@pytest.mark.parametrize(
    ("ended", "own_slopes"), [(Termination.OFFSET, True), (Termination.BEHIND, False)]
)
def test_on_a_finer_mesh_than_usual_a_fit_goes_from_mesh_to_mesh(ended, own_slopes, monkeypatch):
    seen = []

    def fit_effects(problem, names, start, enough=np.inf, *, slopes=None, **_):
        seen.append((problem.resolution, slopes is not None))
        status = FitStatus(termination=ended if slopes is None else Termination.ITERATIONS, message="")
        return fit_of(names, by_trial=[np.ones(FITTED_SAMPLES)], status=status)

    monkeypatch.setattr(fitting, "fit_effects", fit_effects)
    finest = FINE.refined.refined
    fit = fitting.fit_in_turn(replace(NO_LOG, resolution=finest), ("tip_drag",), np.zeros(1))
    meshes = [(FINE, False), (FINE.refined, True), (finest, True)]
    assert seen == meshes + ([(finest, False)] if own_slopes else [])
    assert fit.status.termination is ended


@pytest.mark.parametrize(
    ("scores", "gaps", "kept"),
    [
        ((0.0, 50.0, 500.0, 600.0), (1.0, 1.0, 2.0, 1.0), ["0", "1", "3"]),
        ((0.0, 500.0, 600.0, 700.0, 800.0, 900.0), (1.0,) * 6, ["0", "1", "2", "3"]),
        ((0.0, 10.0, 20.0, 30.0, 40.0, 500.0), (1.0,) * 6, ["0", "1", "2", "3", "4"]),
    ],
    ids=["one above the noise", "a few at it", "as many as there are near the best"],
)
def test_in_question_is_what_is_near_the_best_and_a_few_more_at_the_noise(scores, gaps, kept):
    names = list(LIBRARY)
    ranked = [
        scored([names[i]], score, floor=NoiseFloor(gap=gap, slow=1.0))
        for i, (score, gap) in enumerate(zip(scores, gaps, strict=True))
    ]
    found = in_question(NO_LOG, ranked)
    assert [str(names.index(c.names[0])) for c in found] == kept
