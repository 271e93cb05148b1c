"""Which sets of effects are fitted, and why others are not."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import fit_of, scored

from diagnosis.criteria import (
    CONTENDING,
    FINALISTS,
    MOST_FINALISTS,
    NEAR_FLOOR,
    PROMISE_BROKEN,
    SIMPLE_LEAD,
    SLOPES_OF_ITS_OWN,
)
from diagnosis.effects import LIBRARY
from diagnosis.fitting.fit_status import FitStatus, Termination
from diagnosis.fitting.problem import FitProblem
from diagnosis.prepare.prepared_log import PreparedLog
from diagnosis.selection import fitting
from diagnosis.selection.fitting import fit_all, fit_each_alone, fit_finalists, fit_screened
from diagnosis.selection.record import Decision
from diagnosis.selection.screening import Screened
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed

SAMPLES = 1000
PROBLEM = FitProblem(log=PreparedLog(rig=None, trials=()), noise=None, nuisance=())


class Names(list):
    """Names that were fitted, in order; `allowed`: the costs that they had to come below."""


@pytest.fixture
def made(monkeypatch):
    """Fits that end with the cost that their start says, and the names that were fitted."""
    names, allowed = Names(), []
    names.allowed = allowed

    def fit_effects(_, effects, start=None, enough=np.inf):
        allowed.append(enough)
        names.append(tuple(effects))
        if start is not None and np.isnan(start[0]):
            raise SimulationFailed("lost its numbers")
        cost = SAMPLES if start is None else float(start[0])
        white = np.random.default_rng(len(names)).normal(size=SAMPLES)
        return fit_of(effects, by_trial=[white * np.sqrt(abs(cost) / float(white @ white))], cost=cost)

    monkeypatch.setattr(fitting, "fit_effects", fit_effects)
    monkeypatch.setattr(fitting, "fit_in_turn", fit_effects)
    return names


FOUR = ("tip_drag", "torque_bias", "tip_angle_bias", "coulomb_friction")


def screened(name, promise, fitted=None):
    """An effect that promises a cost, and what its fit comes to."""
    start = np.array([promise if fitted is None else fitted])
    return Screened(names=(name,), start=start, cost=promise, gain=10.0)


def decisions(record):
    return {(e.effects, e.decision): e for e in record}


def test_the_most_promising_are_fitted_first_and_come_back_best_first(made):
    each = [screened("tip_drag", 3000.0, 2000.0), screened("torque_bias", 2500.0, 2900.0)]
    found, record = fit_screened("single", PROBLEM, each, 9, Workers())
    assert made == [("torque_bias",), ("tip_drag",)]
    assert [c.names for c in found] == [("tip_drag",), ("torque_bias",)]
    assert {e.decision for e in record} == {Decision.MADE}


def test_no_more_are_fitted_than_asked_for(made):
    each = [screened("tip_drag", 3000.0), screened("torque_bias", 2500.0)]
    fit_screened("single", PROBLEM, each, 1, Workers())
    assert made == [("torque_bias",)]


BATCH = [
    screened(n, 900.0 + i, 1000.0)
    for i, n in enumerate(("stiction", "tip_drag", "torque_bias", "tip_angle_bias"))
]


def test_once_something_is_at_the_floor_only_what_comes_near_or_is_contained_is_fitted(made):
    far = NEAR_FLOOR * SAMPLES + 100
    later = [
        screened("entry_friction", far),
        screened("coulomb_friction", far),
        screened("tip_angle_scale", 0.9 * far),
    ]
    _, record = fit_screened("single", PROBLEM, [*BATCH, *later], 9, Workers())
    assert ("entry_friction",) not in made
    assert {("coulomb_friction",), ("tip_angle_scale",)} <= set(made)  # stiction contains the one
    out = decisions(record)[("entry_friction",), Decision.DROPPED]
    assert "far above" in out.reason
    assert out.score is None


def test_a_fit_has_to_come_near_the_best_once_that_is_at_the_floor(made):
    """Of what comes later: the cost of the best, and what may be contended."""
    at_floor = [screened(name, 1.0 + i, 0.9 * SAMPLES) for i, name in enumerate(FOUR)]
    later = [screened("entry_friction", 9.0, 2 * SAMPLES)]
    fit_screened("single", PROBLEM, [*at_floor, *later], 9, Workers(), used=6)
    assert made.allowed[:4] == [np.inf] * 4
    # Both have one parameter and are singles, so that their penalties are the same.
    assert made.allowed[4] == pytest.approx(0.9 * SAMPLES + CONTENDING)


def test_as_many_as_are_of_use_are_fitted_to_their_end(made):
    above = [screened(name, 1.0 + i, (4.0 + i) * SAMPLES) for i, name in enumerate(FOUR)]
    later = [screened("entry_friction", 9.0, 9 * SAMPLES)]
    for used, allowed in ((6, np.inf), (2, max(4.0 * SAMPLES + CONTENDING, 5.0 * SAMPLES))):
        made.allowed.clear()
        fit_screened("single", PROBLEM, [*above, *later], 9, Workers(), used=used)
        assert made.allowed[4] == pytest.approx(allowed)


def test_the_best_start_of_a_set_is_kept(made):
    each = [screened("tip_drag", 2000.0, 2500.0), screened("tip_drag", 2100.0, 2200.0)]
    (found,), record = fit_screened("single", PROBLEM, each, 9, Workers())
    assert found.fit.cost == 2200.0
    (out,) = [e for e in record if e.decision is Decision.DROPPED]
    assert "another start" in out.reason


def start_of(names, promise, fitted):
    return replace(screened("tip_drag", promise, fitted), names=names)


def test_the_first_start_of_each_set_is_fitted_before_the_second_of_any(made):
    two, reversed_ = ("tip_drag", "stiction"), ("stiction", "tip_drag")
    each = [
        start_of(two, 3000.0, 3000.0),
        start_of(reversed_, 3100.0, 2900.0),
        start_of(("torque_bias",), 3200.0, 3200.0),
    ]
    found, _ = fit_screened("pairs", PROBLEM, each, 9, Workers())
    assert made == [two, ("torque_bias",), reversed_]
    assert [c.names for c in found] == [reversed_, ("torque_bias",)]


@pytest.mark.parametrize(("promise", "fitted"), [(1.01, False), (0.99, True)])
@pytest.mark.parametrize("left", [1.0, 2.0], ids=["at the floor", "above it"])
def test_another_start_of_a_set_has_to_promise_less(left, promise, fitted, made, monkeypatch):
    monkeypatch.setattr(fitting, "FITS_AT_ONCE", 1)
    first = start_of(("stiction",), 0.9 * left * SAMPLES, left * SAMPLES)
    again = start_of(("stiction",), promise * left * SAMPLES, left * SAMPLES)
    _, record = fit_screened("single effects", PROBLEM, [first, again], 9, Workers())
    assert len(made) == 1 + fitted
    assert (Decision.DROPPED in {e.decision for e in record}) or not fitted


def test_what_leaves_far_more_than_promised_is_fitted_once_more_from_a_neutral_start(made, monkeypatch):
    """Of the two starts of a set, once; and where the promise is kept, not at all."""
    monkeypatch.setattr(
        fitting, "neutral_start", lambda _, one: np.array([0.5 * PROMISE_BROKEN * one.cost])
    )
    broken = start_of(("stiction",), 2000.0, 1.01 * PROMISE_BROKEN * 2000.0)
    twice = start_of(("stiction",), 2100.0, 1.01 * PROMISE_BROKEN * 2100.0)
    kept = start_of(("tip_drag",), 2000.0, 0.99 * PROMISE_BROKEN * 2000.0)
    found, _ = fit_screened("single effects", PROBLEM, [broken, twice, kept], 9, Workers())
    assert made == [("stiction",), ("tip_drag",), ("stiction",), ("stiction",)]
    assert {c.names: c.fit.cost for c in found} == pytest.approx(
        {("stiction",): 0.5 * PROMISE_BROKEN * 2000.0, ("tip_drag",): 0.99 * PROMISE_BROKEN * 2000.0}
    )


def test_a_fit_that_fails_is_recorded_and_the_others_go_on(made):
    each = [screened("tip_drag", 2000.0, np.nan), screened("torque_bias", 2100.0)]
    (found,), record = fit_screened("single", PROBLEM, each, 9, Workers())
    assert found.names == ("torque_bias",)
    assert decisions(record)[("tip_drag",), Decision.FAILED].reason == "lost its numbers"


def test_finalists_are_the_best_within_reach(made):
    names = ("tip_drag", "stiction", "torque_bias", "tip_angle_bias", "tip_angle_scale")
    near = [scored([n], 100.0 + 1.1 * SIMPLE_LEAD * i) for i, n in enumerate(names)]
    far = scored(["entry_friction"], 101.0 + CONTENDING)
    found, record = fit_finalists("finalists", PROBLEM, [*near, far], Workers())
    assert len(found) == FINALISTS == 4
    assert made == [c.names for c in near[:FINALISTS]]
    out = {e.effects: e.reason for e in record if e.decision is Decision.DROPPED}
    assert "4 others are better" in out["tip_angle_scale",]
    assert "by more than 60" in out["entry_friction",]


def test_where_many_fit_about_as_well_more_are_finalists(made):
    alike = [scored([name], 100.0 + 0.1 * i) for i, name in enumerate(list(LIBRARY)[:12])]
    fit_finalists("finalists", PROBLEM, alike[:6], Workers())
    assert len(made) == 6
    made.clear()
    fit_finalists("finalists", PROBLEM, alike, Workers())
    assert len(made) == MOST_FINALISTS


def test_a_finalist_that_stays_far_above_the_noise_is_given_up(made, monkeypatch):
    monkeypatch.setattr(FitProblem, "samples", SAMPLES)
    fit_finalists("finalists", PROBLEM, [scored(["tip_drag"], 1.0)], Workers())
    assert made.allowed == [NEAR_FLOOR * SAMPLES]


def test_no_contender_is_no_finalist(made):
    assert fit_finalists("finalists", PROBLEM, [], Workers()) == ([], ())


def test_each_effect_of_a_candidate_is_fitted_alone_from_where_it_is(made):
    pair = scored(["tip_drag", "torque_bias"], 1.0)
    found, record = fit_each_alone("alone", PROBLEM, pair, pair.names, Workers())
    assert [c.names for c in found] == [("tip_drag",), ("torque_bias",)]
    assert [c.fit.cost for c in found] == [float(pair.fit.parts[n][0]) for n in pair.names]
    assert {e.stage for e in record} == {"alone"}
    assert made.allowed == [pair.score + CONTENDING] * 2


def test_calls_come_back_in_their_order(made):
    calls = [(PROBLEM, (n,), np.array([c])) for n, c in (("tip_drag", 3.0), ("stiction", 1.0))]
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
        return fit_of(names, by_trial=[np.full(SAMPLES, gap)], status=status)

    monkeypatch.setattr(fitting, "fit_effects", fit_effects)
    fitting.fit_in_turn(replace(PROBLEM, callback_alone=decimated), ("tip_drag",), np.zeros(1))
    assert seen == goes
