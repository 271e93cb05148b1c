"""Fitting a set of effects to a log."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import RIG, TIP, TORQUE, fit_of, log_of, problem_of

from diagnosis.criteria.fitting import SCATTER
from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.fitting import fit as module
from diagnosis.fitting.fit import completed, fit_effects, nominal_fit
from diagnosis.fitting.fit_status import FitStatus, Stopping, Termination
from diagnosis.fitting.objective import NearStart
from diagnosis.fitting.parameterization import parameterization_of, starts
from diagnosis.replay.resolution import Resolution
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters


@pytest.fixture(scope="module")
def dry():
    """A log with dry friction."""
    return problem_of(log_of(RigParameters(kinetic_n_mm_per_mm=0.001)))


def start_of(problem, name):
    """The first start of an effect, nothing else off."""
    return parameterization_of((name,), problem.nuisance).joined({name: starts(LIBRARY[name])[0]})


def test_a_fit_finds_what_the_log_has_and_converges(dry):
    fit = fit_effects(dry, ("coulomb_friction",), start_of(dry, "coulomb_friction"))
    assert np.exp(fit.x[0]) == pytest.approx(0.001, rel=0.02)
    # N readings of one unit each: 1 / sqrt(2 N) of chance, and 2 % of the noise's estimate.
    assert fit.gap == pytest.approx(1.0, abs=4 / np.sqrt(2 * fit.samples) + 0.04)
    assert fit.status.converged
    assert fit.status.termination is Termination.OFFSET
    assert fit.status.message.startswith("converged after ")
    assert fit.status.at_bound == ()
    assert fit.size == 1


def test_slopes_are_those_of_central_differences(dry):
    fit = fit_effects(dry, ("coulomb_friction",), start_of(dry, "coulomb_friction"))
    for entry, step in enumerate(0.01 * np.eye(fit.x.size)):
        ahead, behind = (
            dry.residuals([fit.parameterization.rig(fit.x + s * step)])[0][0] for s in (1, -1)
        )
        slope = (ahead - behind) / 0.02
        # One-sided differences of 0.001, of the last iterate but one: a few per cent.
        assert np.linalg.norm(fit.jacobian[0][:, entry] - slope) < 0.05 * np.linalg.norm(slope)


def test_a_finer_replay_is_fitted_as_well_with_the_slopes_of_the_usual_one(dry):
    """Slopes that are a few per cent off lead to the same minimum; the tolerance is 2 % of sigma."""
    usual = fit_effects(dry, ("coulomb_friction",), start_of(dry, "coulomb_friction"))
    assert usual.slopes.shape == (usual.samples + usual.x.size, usual.x.size)
    finer = replace(dry, resolution=Resolution(elements=24, step_s=0.005))
    anew = fit_effects(finer, usual.names, usual.x)
    known = fit_effects(finer, usual.names, usual.x, slopes=usual.slopes)
    sigma = np.sqrt(np.diag(np.linalg.inv(usual.slopes.T @ usual.slopes)))
    assert np.all(np.abs(known.x - anew.x) < 0.1 * sigma)
    assert known.cost == pytest.approx(anew.cost, abs=0.1)
    np.testing.assert_array_equal(known.slopes, usual.slopes)


def test_a_fit_that_is_stopped_early_says_so(dry):
    start = start_of(dry, "coulomb_friction")
    fit = fit_effects(dry, ("coulomb_friction",), start, most_iterations=1)
    assert fit.status.termination is Termination.ITERATIONS
    assert "the most that are allowed" in fit.status.message
    assert not fit.status.converged


def test_a_fit_that_cannot_come_below_what_is_enough_is_given_up(dry):
    """A bias of the tip takes nothing off what dry friction leaves; dry friction takes all of it."""
    nominal = fit_effects(dry, ())
    enough = 0.5 * nominal.cost
    behind = fit_effects(dry, ("tip_angle_bias",), start_of(dry, "tip_angle_bias"), enough)
    assert behind.status.termination is Termination.BEHIND
    assert not behind.status.converged
    useful = fit_effects(dry, ("coulomb_friction",), start_of(dry, "coulomb_friction"), enough)
    assert useful.status.converged
    assert useful.cost < enough


def test_a_fit_that_was_given_up_is_taken_on_to_its_end(dry, monkeypatch):
    """And ends there, however slow and far above the noise it is."""
    names, start = ("coulomb_friction",), start_of(dry, "coulomb_friction")
    begun = fit_effects(dry, names, start, most_iterations=1)
    assert completed(dry, begun) is begun  # that was not given up
    far = FitStatus(termination=Termination.FAR, message="far")
    again = completed(dry, replace(begun, status=far))
    whole = fit_effects(dry, names, start)
    sigma = np.sqrt(np.diag(np.linalg.inv(whole.slopes.T @ whole.slopes)))
    assert again.status.converged
    assert np.all(np.abs(again.x - whole.x) < 0.1 * sigma)
    allowed = []
    monkeypatch.setattr(
        module, "Stopping", lambda *args, far: allowed.append(far) or Stopping(*args, far=far)
    )
    completed(dry, replace(begun, status=far))
    assert allowed == [np.inf]


def test_a_parameter_that_stops_at_a_bound_is_named():
    """A tip that is ahead of time asks for a delay below none."""
    problem = problem_of(log_of(RigParameters(tip_delay_s=-0.05), seconds=6.0))
    fit = fit_effects(problem, ("tip_sensor_delay",), start_of(problem, "tip_sensor_delay"))
    assert fit.x[0] == 0.0
    assert fit.status.at_bound == ("tip_sensor_delay.delay",)


def test_a_past_that_stops_at_a_bound_is_no_parameter_of_an_effect():
    past = Effect(
        name="start of a.csv",
        title="what the base turned by before a.csv began",
        place=Place.DRIVE,
        parameters=(Parameter(name="wound", unit="deg", low=-1.0, high=1.0, start=(0.0,)),),
        apply=lambda rig, _: rig,
        trial="a.csv",
    )
    most = parameterization_of(("tip_drag",)).bounds()[1][0]
    for x, at_bound in (((0.0, 1.0), True), ((0.0, 0.5), False), ((most, 0.5), False)):
        found = fit_of(("tip_drag",), nuisance=(past,), x=x)
        assert found.trial_at_bound is at_bound
        assert not found.status.at_bound


def test_the_cost_is_that_of_residuals_and_of_the_prior():
    problem = problem_of(log_of(RigParameters(stiffness_scale=1.03), seconds=6.0))
    fit = fit_effects(problem, ())
    off = [float(fit.parts[name][0]) / SCATTER[name] for name in SCATTER]
    assert off[0] > 1
    left = sum(float(r @ r) for r in fit.by_trial)
    assert fit.cost == pytest.approx(left + sum(o**2 for o in off))
    (again,) = problem.residuals([fit.parameterization.rig(fit.x)])
    np.testing.assert_array_equal(fit.by_trial[0], again[0])


def test_a_start_beyond_bounds_is_brought_within(dry):
    start = start_of(dry, "coulomb_friction")
    start[0] = 10.0
    fit = fit_effects(dry, ("coulomb_friction",), start, most_iterations=1)
    assert fit.x[0] <= np.log(0.05)


def test_nothing_to_fit_is_the_nominal_rig(dry):
    bare = replace(dry, nuisance=())
    fit = fit_effects(bare, ())
    assert fit.status.termination is Termination.NOTHING_TO_FIT
    assert fit.status.converged
    assert fit.names == ()
    by_trial = [r[0] for r in bare.residuals([NOMINAL])]
    assert fit.cost == nominal_fit(by_trial).cost == pytest.approx(float(by_trial[0] @ by_trial[0]))
    assert nominal_fit(by_trial).jacobian[0].shape == (fit.samples, 0)


@pytest.mark.parametrize("modulus", [1000.0, 0.01])
def test_a_needle_at_an_end_of_the_legal_range_can_be_fitted(modulus):
    """rig.yaml may say so, and a stiffness that is left open goes beyond."""
    rig = RIG.but(needle=RIG.needle.but(shear_modulus_gpa=modulus))
    log = replace(log_of(NOMINAL, seconds=3.0), rig=rig)
    sigma = {"tip_angle_deg": TIP, "base_torque_n_mm": TORQUE, "base_angle_deg": 0.0}
    fit = fit_effects(problem_of(log, sigma=sigma), ("stiffness_error",), most_iterations=3)
    assert np.isfinite(fit.cost)


def test_what_is_known_of_the_start_is_not_taken_for_where_the_fit_has_gone(dry, monkeypatch):
    """Of an effect that is fitted with wide differences, then with narrow ones from there."""
    effect = replace(LIBRARY["tip_drag"], differences=(1e-1, 1e-3))
    problem = replace(dry, library={**dry.library, "tip_drag": effect})
    start, known = start_of(problem, "tip_drag"), []
    monkeypatch.setattr(module.Objective, "learn_from", lambda _, x, near: known.append((x, near)))
    near = NearStart(slopes=np.zeros((0, 0)), by_trial=None)
    fit = fit_effects(problem, ("tip_drag",), start, near=near)
    assert not np.allclose(fit.x, start)
    ((at, given),) = known
    np.testing.assert_array_equal(at, start)
    assert given is near
