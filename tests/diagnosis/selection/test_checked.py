"""Candidates in units of the noise that the best of them leaves, and on held-out trials."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import BASE, TIP, TORQUE, log_of, problem_of

from diagnosis.criteria.fitting import NOISE_TRUST
from diagnosis.fitting.fit import nominal_fit
from diagnosis.fitting.fit_status import FitStatus, Termination
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.selection import candidate as module
from diagnosis.selection import checked as checked_module
from diagnosis.selection.candidate import candidate
from diagnosis.selection.checked import check

QUIET = {"tip_angle_deg": TIP, "base_torque_n_mm": TORQUE, "base_angle_deg": BASE}
OVERSTATED = {"tip_angle_deg": 1.05 * TIP, "base_torque_n_mm": 1.05 * TORQUE, "base_angle_deg": BASE}


def nominal(problem):
    """The nominal rig as a candidate."""
    return candidate(nominal_fit([r[0] for r in problem.residuals([NOMINAL])]))


@pytest.fixture(scope="module")
def problem():
    return problem_of(log_of(NOMINAL), sigma=OVERSTATED)


def test_noise_is_that_which_the_best_leaves_and_costs_are_in_its_units(problem):
    before = nominal(problem)
    checked = check(problem, [before])
    noise, (after,) = checked.noise, checked.candidates
    # First differences of 1200 samples: 2.5 % of standard error.
    assert noise["tip_angle_deg"] == pytest.approx(TIP, rel=3 * np.sqrt(0.75 / 1200))
    assert abs(noise["tip_angle_deg"] / OVERSTATED["tip_angle_deg"] - 1) <= NOISE_TRUST
    factors = np.repeat(
        [problem.noise[s] / noise[s] for s in ("base_torque_n_mm", "tip_angle_deg")], 1200
    )
    np.testing.assert_allclose(after.fit.by_trial[0], before.fit.by_trial[0] * factors)


def test_what_is_at_the_floor_is_checked_on_held_out_trials(problem):
    (checked,) = check(problem, [nominal(problem)]).candidates
    assert checked.held_out is not None
    assert checked.explains


def test_candidates_come_back_best_first(problem):
    worse = candidate(nominal_fit([1.5 * r[0] for r in problem.residuals([NOMINAL])]))
    found = check(problem, [worse, nominal(problem)]).candidates
    assert [c.score for c in found] == sorted(c.score for c in found)
    assert found[-1].floor.gap == pytest.approx(1.5 * found[0].floor.gap)


def test_whether_any_explains(problem):
    assert check(problem, [nominal(problem)]).explains
    dry = problem_of(log_of(RigParameters(kinetic_n_mm_per_mm=0.001)), sigma=OVERSTATED)
    assert not check(dry, [nominal(dry)]).explains


def test_what_was_checked_is_not_simulated_once_more_unless_the_noise_is_another(problem, monkeypatch):
    best = nominal(problem)
    known = check(problem, [best])
    worse = candidate(nominal_fit([1.5 * r for r in best.fit.by_trial]))
    simulated = []
    monkeypatch.setattr(
        module, "held_out_or_refitted", lambda _, fit: simulated.append(fit) or fit.by_trial
    )
    assert check(problem, [best, worse], known).candidates[0] is known.candidates[0]
    assert not simulated
    louder = replace(problem, noise=replace(problem.noise, sigma=QUIET))
    assert known.of(best.fit, louder.noise) is None
    check(louder, [best], known)
    assert len(simulated) == 1


def test_noise_is_estimated_once_from_what_one_fit_leaves(problem, monkeypatch):
    best, estimated = nominal(problem), []
    known = check(problem, [best])
    monkeypatch.setattr(
        checked_module,
        "reestimated_noise",
        lambda own, fit: estimated.append(fit) or own.noise,
    )
    worse = candidate(nominal_fit([1.5 * r for r in best.fit.by_trial]))
    assert check(problem, [worse, best], known).noise is known.noise
    assert not estimated
    better = candidate(nominal_fit([0.9 * r for r in best.fit.by_trial]))
    check(problem, [best, better], known)
    check(replace(problem), [best], known)
    assert [id(fit) for fit in estimated] == [id(better.fit), id(best.fit)]


@pytest.mark.parametrize(
    ("gap", "end", "goes_on"),
    [
        (1.0, Termination.FAR, True),
        (1.0, Termination.STALLED, False),
        (1.5, Termination.FAR, False),
    ],
)
def test_what_explains_the_log_after_all_has_the_values_of_the_minimum(
    problem, monkeypatch, gap, end, goes_on
):
    """A fit may have been given up above the floor, before the noise of the base was allowed for."""
    fit = nominal(problem).fit
    given_up = replace(
        fit,
        by_trial=tuple(gap * r for r in fit.by_trial),
        cost=gap**2 * fit.cost,
        status=FitStatus(termination=end, message=""),
    )
    whole = replace(fit, cost=fit.cost - 50.0)
    asked = []
    monkeypatch.setattr(checked_module, "completed", lambda _, one: asked.append(one) or whole)
    (checked,) = check(problem, [candidate(given_up)]).candidates
    assert bool(asked) is goes_on
    assert (checked.fit is whole) is goes_on
    assert checked.explains is (gap == 1.0)
