"""The best explanation taken apart."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from diagnosis_fixtures import concluded, fit_of, log_of, problem_of, scored, start_of_search

from diagnosis.criteria.fitting import SCATTER
from diagnosis.criteria.selection import CONTENDING
from diagnosis.effects import LIBRARY
from diagnosis.fitting.fit_status import FitStatus, Termination
from diagnosis.fitting.noise_floor import NoiseFloor
from diagnosis.fitting.parameterization import parameterization_of
from diagnosis.replay.replay import replay
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.selection import candidate, checked
from diagnosis.selection.search import search
from diagnosis.selection.stages import best as module
from diagnosis.workers import Workers


def test_one_effect_has_nothing_to_be_taken_apart(asked, still_start):
    state = replace(still_start, candidates=(scored(["tip_drag"], 1.0),))
    module.best_without_each_effect(state, Workers())
    assert asked == []


def test_of_three_effects_each_is_left_out_in_turn_but_for_what_was_fitted(asked, still_start):
    three = ("tip_drag", "torque_bias", "stiction")
    found = [scored(three, 1.0), scored(["torque_bias", "tip_drag"], 2.0)]
    module.best_without_each_effect(replace(still_start, candidates=found), Workers())
    assert asked == [("tip_drag", "stiction"), ("torque_bias", "stiction")]


@pytest.mark.parametrize(("slow", "fitted"), [(0.99, 2), (1.01, 0)])
def test_above_the_noise_none_is_left_out(slow, fitted, asked, still_start, monkeypatch):
    """Where the best leaves more than noise, so does it without one of its effects."""
    pair = scored(["tip_drag", "torque_bias"], 1.0)
    left = replace(pair.floor, slow=slow * pair.floor.slow_limit)
    monkeypatch.setattr(checked, "candidate", lambda _: replace(pair, floor=left))
    monkeypatch.setattr(checked, "_checked", lambda one, _: one)
    module.best_without_each_effect(replace(still_start, candidates=(pair,)), Workers())
    assert len(asked) == fitted


@pytest.mark.parametrize(("behind", "again"), [(30.0, True), (5.0, False)])
def test_a_part_of_the_best_that_ended_elsewhere_begins_once_more_from_the_best(
    behind, again, asked, still_start, monkeypatch
):
    """Slopes of 10 and an offset of 0.1 promise that readings miss the second effect by 1 in cost."""
    pair = scored(["tip_drag", "tip_angle_scale"], 1.0)
    own = pair.fit.parameterization
    x = own.joined({"tip_angle_scale": np.array([0.1])})
    slopes = np.zeros((1000, x.size))
    slopes[0, x == 0.1] = 10.0
    fit = replace(pair.fit, x=x, by_trial=(np.zeros(1000),), jacobian=(slopes,), cost=1000.0)
    pair = replace(pair, fit=fit)
    alone = scored(["tip_drag"], 40.0)
    alone = replace(alone, fit=replace(alone.fit, cost=1001.0 + behind))
    monkeypatch.setattr(module.SearchState, "rechecked", lambda self: (self, True))
    monkeypatch.setattr(module.SearchState, "at_the_floor", lambda *_: True)
    module.best_without_each_effect(replace(still_start, candidates=(pair, alone)), Workers())
    assert (("tip_drag",) in asked) is again


def test_a_fit_of_the_best_that_was_given_up_is_taken_to_its_end(monkeypatch, still_start):
    asked = []

    def fit_all(stage, calls, workers):
        asked.append((stage, [call[1] for call in calls], len(calls[0])))
        return [], ()

    monkeypatch.setattr(module, "fit_all", fit_all)
    ended = scored(["tip_drag"], 1.0)
    module.best_to_its_end(replace(still_start, candidates=(ended,)), Workers())
    assert asked == []
    behind = FitStatus(termination=Termination.BEHIND, message="behind")
    given_up = replace(ended, fit=replace(ended.fit, status=behind))
    module.best_to_its_end(replace(still_start, candidates=(given_up,)), Workers())
    assert asked == [("best to its end", [("tip_drag",)], 3)]  # without a cost that is enough


@pytest.mark.slow
def test_a_constant_that_the_best_names_is_fitted_without_its_prior():
    off = start_of_search(log_of(RigParameters(stiffness_scale=1.2), speed=-1.0, seconds=8.0), ())
    found = search(off, Workers())
    (entry,) = [e for e in found.record if e.stage == "scatter of the best"]
    assert entry.effects == ("stiffness_error",)
    best = concluded(found)
    assert best.effects == ("stiffness_error",)
    assert np.exp(best.best.fit.parts["stiffness_error"][0]) == pytest.approx(1.2, rel=0.01)


OFF = 0.2
LINEAR = np.random.default_rng(1).normal(size=(1000, 1))


def off(names, cost=0.0, *, reached=False, gap=1.0, gain=0.0):
    """A candidate, fitted to 1000 readings, whose stiffness is off by 20 % against its prior.

    Args:
      gain: that the readings would have of more of it, were there no prior.
    """
    one = scored(names, cost)
    nuisance = (LIBRARY["stiffness_error"],)
    parameterization = parameterization_of(names, nuisance)
    x = parameterization.joined({"stiffness_error": np.array([OFF])})
    beside = np.zeros((1000, x.size - 1))
    unit = LINEAR / np.linalg.norm(LINEAR)
    across = np.random.default_rng(2).normal(size=1000)
    across -= unit[:, 0] * (unit[:, 0] @ across)
    left = np.sqrt(gain) * unit[:, 0] + across / np.linalg.norm(across) * np.sqrt(1000 * gap**2 - gain)
    fit = fit_of(
        names, by_trial=[left], jacobian=[np.hstack([beside, 1e3 * unit])], x=x, nuisance=nuisance
    )
    floor = NoiseFloor(gap=gap, slow=1.0 if reached else 2.0, gap_limit=1.02)
    return replace(one, fit=fit, floor=floor, score=cost + fit.prior)


def found_by_then(best, *others):
    return SimpleNamespace(
        best=best,
        candidates=(best, *others),
        problem=SimpleNamespace(parameterization=lambda names: parameterization_of(names)),
        adding=lambda made: made,
    )


def test_sets_that_the_prior_of_scatter_alone_keeps_behind_are_freed_of_it_too(asked):
    best, near = off(("tip_drag",)), off(("tip_angle_scale",), 5.0, reached=True)
    far = off(("torque_bias",), 10.0 + CONTENDING, reached=True)
    above = off(("stiction",), 5.0)
    assert best.scatter_named == ("stiffness_error",)
    module.scatter_of_the_best(found_by_then(best, near, far, above), Workers())
    assert asked == [("tip_drag", "stiffness_error"), ("tip_angle_scale", "stiffness_error")]


@pytest.mark.parametrize(("share", "fitted"), [(1.01, 1), (0.99, 0)])
def test_scatter_is_freed_only_where_its_prior_may_be_what_keeps_the_best_above_the_noise(
    share, fitted, asked
):
    """What the readings would gain of more of it has to make up for what is beyond the limit."""
    gain = 100.0 * share
    best = off(("tip_drag",), gap=np.sqrt(1.02**2 + 100.0 / 1000), gain=gain)
    module.scatter_of_the_best(found_by_then(best), Workers())
    assert asked == [("tip_drag", "stiffness_error")][:fitted]


def off_alike(*names):
    """A candidate whose stiffness and damping are off by 5 %, and told as sharply."""
    told = np.random.default_rng(3).normal(0, 1e3, (10, 2))
    rows = np.hstack([np.zeros((10, len(names))), told])
    x = np.array([*(-3.0 for _ in names), 0.05, 0.05])
    scales = tuple(LIBRARY[name] for name in SCATTER)
    fit = fit_of(names, x=x, jacobian=[rows], by_trial=[np.zeros(10)], nuisance=scales)
    return replace(scored(names, 1.0), fit=fit)


def test_where_both_are_off_the_gain_that_is_both_alike_is_fitted_in_their_place_as_well(asked):
    best = off_alike("tip_drag")
    assert best.scatter_named == tuple(SCATTER)
    module.scatter_of_the_best(found_by_then(best), Workers())
    assert asked == [("tip_drag", *SCATTER), ("tip_drag", module.BOTH_ALIKE)]


def test_the_gain_that_is_both_alike_reads_as_stiffness_and_damping_that_are_off_by_the_same():
    """Torque is proportional to both, and inertia is small."""
    gain = LIBRARY[module.BOTH_ALIKE].apply(NOMINAL, 1.05)
    both = replace(NOMINAL, stiffness_scale=1.05, damping_scale=1.05)
    log = problem_of(log_of(NOMINAL)).log
    for one, other in zip(replay(log, gain), replay(log, both), strict=True):
        for sensor, noise in (("tip_angle_deg", 0.01), ("base_torque_n_mm", 1e-3)):
            np.testing.assert_allclose(one[sensor], other[sensor], atol=noise)


def left(gap, *names):
    """A set of effects with what it leaves."""
    return candidate.candidate(fit_of(names, by_trial=[np.full(1000, gap)]))


@pytest.mark.parametrize(
    ("gap", "known", "fitted"),
    [
        (30.0, (), [("coulomb_friction", "tip_drag"), ("coulomb_friction", "torque_bias")]),
        (30.0, ("tip_drag", "coulomb_friction"), [("coulomb_friction", "torque_bias")]),
        (1.5, (), []),
    ],
    ids=["far above the noise", "one is known", "near the noise"],
)
def test_plainer_sets_that_leave_hardly_more_go_to_the_log(gap, known, fitted, asked, still_start):
    best = left(gap, "stiction", "tip_drag")
    pairs = [
        left(40.0, "stiction", "tip_drag"),
        left(40.1, "coulomb_friction", "torque_bias"),
        left(40.2, "coulomb_friction", "tip_drag"),
        left(40.3, "entry_friction", "torque_bias"),
        left(41.0, "sheath_friction", "tip_drag"),
        left(40.1, "stiction", "torque_bias"),
    ]
    candidates = (best, *([left(31.0, *known)] if known else ()))
    state = replace(still_start, candidates=candidates, pairs=tuple(pairs))
    module.plainer_sets(state, Workers())
    assert asked[: len(fitted)] == fitted
    assert len(asked) == (2 if fitted else 0)
