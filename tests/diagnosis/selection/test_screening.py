"""What an effect could explain at best, before a fit."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import coarse_of, log_of, problem_of

from diagnosis.criteria.selection import PREDICTION_MISSED
from diagnosis.effects import LIBRARY
from diagnosis.fitting.fit import fit_effects
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.screening import neutral_start, screen


@pytest.fixture(scope="module")
def dry():
    """A decimated log with dry friction, and the fit of its scatter alone."""
    coarse = coarse_of(log_of(RigParameters(kinetic_n_mm_per_mm=0.001)))
    return coarse, fit_effects(coarse, ())


def test_what_the_log_has_promises_most(dry):
    names = ("coulomb_friction", "tip_drag", "torque_bias", "chuck_backlash")
    promises = {name: screen(*dry, name)[0] for name in names}
    assert min(promises, key=lambda name: promises[name].cost) == "coulomb_friction"
    best = promises["coulomb_friction"]
    assert best.gain > 0.9 * dry[1].cost
    without = best.cost + best.gain
    for one in promises.values():
        assert one.cost + one.gain == pytest.approx(without)


def test_a_fit_from_there_comes_near_what_was_promised(dry):
    coarse, base = dry
    best = screen(coarse, base, "coulomb_friction")[0]
    fit = fit_effects(coarse, best.names, best.start)
    assert fit.cost < base.cost - 0.9 * best.gain


def test_as_many_starts_as_parameters_come_back_best_first(dry):
    found = screen(*dry, "stiction")
    assert len(found) == len(LIBRARY["stiction"].parameters)
    assert [s.cost for s in found] == sorted(s.cost for s in found)
    assert len(screen(*dry, "stiction", most_starts=2)) == 2
    assert {s.names for s in found} == {("stiction",)}


def test_a_fit_begins_where_the_linear_model_leads(dry):
    """Dry friction takes back from the nuisance what that had taken over."""
    coarse, base = dry
    taken_over = base.parts["damping_error"][0]
    assert abs(taken_over) > 0.01
    best = screen(coarse, base, "coulomb_friction")[0]
    parameterization = coarse.parameterization(best.names)
    begun = parameterization.parts(best.start)
    assert abs(begun["damping_error"][0]) < 0.2 * abs(taken_over)
    left = coarse.residuals([parameterization.rig(best.start)])
    assert sum(float(r[0] @ r[0]) for r in left) < 0.1 * base.cost


@pytest.mark.parametrize("name", ["coulomb_friction", "tip_drag", "tissue_viscoelasticity"])
def test_runs_half_as_fine_promise_the_same(dry, name):
    """What an effect changes is off by 1 to 5 %, mostly along itself, which its size takes up."""
    coarse, base = dry
    assert coarse.of_differences.resolution == coarse.resolution.halved
    rough = screen(coarse, base, name)[0]
    fine = screen(replace(coarse, differences_halved=False), base, name)[0]
    assert rough.cost == pytest.approx(fine.cost, abs=0.01 * base.cost)
    assert rough.gain == pytest.approx(fine.gain, abs=0.01 * base.cost)


def test_an_effect_begins_no_stronger_than_three_times_a_start():
    """Dry friction that holds the tip: no start of it comes near, and the linear model asks for more."""
    coarse = coarse_of(log_of(RigParameters(kinetic_n_mm_per_mm=0.02)))
    begun = screen(coarse, fit_effects(coarse, ()), "coulomb_friction")[0].start[0]
    level = coarse.library["coulomb_friction"].parameters[0]
    assert min(abs(np.exp(begun) / start - 3.0) for start in level.start) < 1e-6


def test_from_a_neutral_start_an_effect_is_found_that_the_nuisance_hides():
    """Drag at the tip that damping has taken over by 60 %: from there, the fit comes nowhere."""
    coarse = coarse_of(log_of(RigParameters(tip_drag_n_mm_s_per_rad=1.0)))
    base = fit_effects(coarse, ())
    assert base.parts["damping_error"][0] > 0.4
    best = screen(coarse, base, "tip_drag")[0]
    start = neutral_start(coarse, best)
    np.testing.assert_array_equal(start[1:], 0.0)
    led, neutral = (fit_effects(coarse, best.names, x) for x in (best.start, start))
    assert led.cost > PREDICTION_MISSED * best.cost
    assert np.exp(neutral.x[0]) == pytest.approx(1.0, rel=0.05)


def test_what_scatter_has_found_costs_only_its_prior_to_name():
    """A stiffness that is far off is found as scatter first; screening need not move it."""
    problem = problem_of(log_of(RigParameters(stiffness_scale=1.43)))
    base = fit_effects(problem, ())
    scale = base.parts["stiffness_error"]
    assert np.exp(scale[0]) == pytest.approx(1.43, rel=0.02)
    best = screen(problem, base, "stiffness_error")[0]
    parameterization = base.parameterization
    prior = parameterization.weights[parameterization.owners.index("stiffness_error")] * scale[0]
    assert prior**2 > 100
    # The rest of the fit is where it is for the sake of the prior too, a little.
    assert best.cost == pytest.approx(base.cost - prior**2, rel=0.01)
    assert best.start[0] == pytest.approx(scale[0])


def test_where_nothing_but_noise_is_left_fits_begin_weak():
    """Two layers of ratio 1.05 are far from any strong start, from which a fit may end elsewhere."""
    coarse = coarse_of(log_of(RigParameters(layer_ratio=1.05)))
    base = fit_effects(coarse, ())
    best = screen(coarse, base, "layered_tissue")[0]
    assert np.exp(abs(best.start[0])) == pytest.approx(1.05, abs=0.05)
