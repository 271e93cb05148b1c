"""A lead over a part counts as far as the errors of the replay do not make it."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import log_of, scored, start_of_search

from diagnosis.fitting.fit import fit_effects
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.candidate import candidate
from diagnosis.selection.scoring import replay_errors as module
from diagnosis.selection.scoring.replay_errors import without_replay_errors

UNIT = np.array([0.6, 0.8, 0.0, 0.0])


def fitted(names, residual, cost):
    one = scored(names, cost)
    return replace(one, fit=replace(one.fit, by_trial=(residual,), cost=cost))


@pytest.mark.parametrize("size", [0.0, 0.5, 3.0])
def test_along_the_difference_errors_add_to_the_variance_of_the_noise(size, monkeypatch, still_start):
    """A lead of 25 in the direction of UNIT; of the errors only what is along it counts."""
    both = fitted(["tip_drag", "torque_bias"], np.zeros(4), 100.0)
    alone = fitted(["tip_drag"], 5.0 * UNIT, 125.0)
    across = np.array([0.0, 0.0, 7.0, 0.0])
    monkeypatch.setattr(module, "_errors", lambda *_: [size * UNIT + across, -size * UNIT])
    found = without_replay_errors(still_start.problem, [both, alone])
    scores = {c.names: c.score for c in found}
    assert scores["tip_drag",] == alone.score
    lead = scores["tip_drag",] - scores["tip_drag", "torque_bias"]
    assert lead == pytest.approx(25.0 / (1.0 + size**2))
    assert [c.score for c in found] == sorted(scores.values())


def test_what_a_part_needs_of_the_prior_no_error_makes(monkeypatch, still_start):
    """Damping that is off by 30 %, named or as scatter of the rig, leaves the same but for a hair."""
    named = fitted(["damping_error"], np.zeros(4), 100.0)
    parameterization = still_start.problem.parameterization(())
    x = parameterization.joined({"damping_error": np.array([np.log(1.3)])})
    own = {"by_trial": (0.1 * UNIT,), "jacobian": (np.zeros((4, x.size)),)}
    fit = replace(named.fit, names=(), parameterization=parameterization, x=x, **own)
    assert fit.prior > 50.0
    scattered = replace(named, fit=replace(fit, cost=100.01 + fit.prior), score=100.01 + fit.prior)
    monkeypatch.setattr(module, "_errors", lambda *_: [3.0 * UNIT, -3.0 * UNIT])
    found = without_replay_errors(still_start.problem, [named, scattered])
    assert {c.names: c.score for c in found}["damping_error",] == pytest.approx(100.01, abs=0.01)


@pytest.mark.parametrize("size", [0.0, 1.0, 3.0])
def test_a_rival_is_as_near_as_errors_may_bring_it(size, monkeypatch, still_start):
    """A lead in cost of 25, and of 4 for what it says in fewer words, which no error makes."""
    best = fitted(["tip_drag", "torque_bias"], np.zeros(4), 100.0)
    rival = replace(fitted(["stiction"], 5.0 * UNIT, 125.0), score=best.score + 21.0)
    monkeypatch.setattr(module, "_errors", lambda *_: [size * UNIT, -size * UNIT])
    scores = {c.names: c.score for c in without_replay_errors(still_start.problem, [best, rival])}
    assert scores[best.names] == best.score
    assert scores[rival.names] - best.score == pytest.approx(25.0 / (1.0 + size**2) - 4.0)


@pytest.mark.parametrize("length", [8.0, 20.0])
def test_between_two_rivals_a_part_that_both_lead_decides_nothing(length, monkeypatch, still_start):
    """Errors are more like the first one, which leads the part by the square of the length, but it is
    the likelier one; of a lead of 400 it loses more than anything that is far behind is."""
    across = np.array([0.0, 0.0, 1.0, 0.0])
    part = fitted([], np.zeros(4), 136.0 + length**2)
    one = fitted(["tip_drag"], length * UNIT, 136.0)
    other = fitted(["stiction"], length * across, 138.0)
    monkeypatch.setattr(module, "_errors", lambda *_: [1.5 * UNIT, -1.5 * UNIT])
    scores = {c.names: c.score for c in without_replay_errors(still_start.problem, [one, other, part])}
    assert scores[other.names] == other.score
    assert scores[one.names] <= other.score
    assert abs(scores[one.names] - other.score) < 10.0


def test_what_is_far_behind_or_above_the_floor_changes_nothing(monkeypatch, still_start):
    """No error is simulated where no lead is to be judged."""
    monkeypatch.setattr(module, "_errors", lambda *_: pytest.fail("simulated"))
    both = fitted(["tip_drag", "torque_bias"], np.zeros(4), 100.0)
    other = fitted(["stiction"], 9.0 * UNIT, 181.0)
    far = fitted(["tip_drag"], 50.0 * UNIT, 2600.0)
    far = replace(far, floor=replace(far.floor, gap=2.0 * far.floor.gap_limit))
    assert without_replay_errors(still_start.problem, [both, other, far]) == [both, other, far]


@pytest.mark.slow
def test_a_lead_that_readings_demand_stands(dry_start):
    """A bias of ten standard deviations of its estimate is no error of the replay."""
    log = log_of(RigParameters(kinetic_n_mm_per_mm=0.001, tip_bias_deg=0.05), speed=-1.0)
    problem = start_of_search(log, ("coulomb_friction", "tip_angle_bias")).problem
    each = [
        candidate(fit_effects(problem, names))
        for names in (("coulomb_friction", "tip_angle_bias"), ("coulomb_friction",))
    ]
    lead = each[1].score - each[0].score
    both, alone = (
        next(c for c in without_replay_errors(problem, each) if c.names == e.names) for e in each
    )
    assert alone.score - both.score > 0.5 * lead > 0.0
