"""The first fit of a family: its fine coordinates are left at 0, and cost nothing."""

import numpy as np
import pytest
from diagnosis_fixtures import log_of, problem_of
from free_forms import CURVE, family_of

from diagnosis.fitting.fit import fit_effects
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.families.interface import families
from diagnosis.freeform.family import coordinates_of
from diagnosis.freeform.fits import first_fit as first_fit_module
from diagnosis.freeform.fits.first_fit import first_fit, with_fine, without_fine
from diagnosis.freeform.fits.free_fit import with_family
from diagnosis.freeform.ranges import ranges_of
from diagnosis.freeform.smooth_curve import separate_values
from diagnosis.replay.replay import replay
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.screening import Screened
from sim.needles.run import SimulationFailed


def test_fine_coordinates_are_those_that_change_a_curve_least():
    """Of the rest of a smooth curve, and of no values that are independent of each other."""
    sizes = np.linalg.norm(CURVE.basis[:, CURVE.straight :], axis=0)
    fine = [p.fine for p in coordinates_of(CURVE)]
    assert fine == [False] * CURVE.straight + [bool(own) for own in sizes < 0.3 * sizes.max()]
    assert 0 < sum(fine) < CURVE.size - CURVE.straight
    assert not any(p.fine for p in coordinates_of(separate_values(np.arange(1.0, 6.0))))


def test_without_them_a_family_is_itself_where_they_are_0():
    given = []
    family = family_of()
    effect = family.effect
    family = family_of(parameters=effect.parameters)
    object.__setattr__(family.effect, "apply", lambda rig, *values: given.append(values) or rig)
    coarse = without_fine(family)
    kept = [i for i, p in enumerate(effect.parameters) if not p.fine]
    assert len(coarse.effect.parameters) == len(kept) < len(effect.parameters)
    coarse.effect.apply(RigParameters(), *range(1, len(kept) + 1))
    expected = np.zeros(len(effect.parameters))
    expected[kept] = np.arange(1, len(kept) + 1)
    np.testing.assert_array_equal(given[0], expected)
    assert without_fine(coarse) is coarse


def test_a_first_fit_is_one_of_the_whole_family_of_whose_fine_coordinates_nothing_is_known():
    log = log_of(RigParameters(damping_scale=1.3), seconds=8.0)
    problem = problem_of(log)
    ranges = ranges_of(problem, replay(problem.log))
    family = next(f for f in families(ranges) if f.name == "damping over time")
    base = fit_effects(problem, ())
    found = first_fit(problem, base, family)
    fine = np.array([p.fine for p in found.fit.parameterization.parameters])
    assert found.family is family
    assert found.fit.x.size == problem_size(problem, family)
    assert fine.any()
    np.testing.assert_array_equal(found.fit.x[fine], 0.0)
    assert not any(slopes[:, fine].any() for slopes in found.fit.jacobian)
    assert found.fit.cost < base.cost
    # With all coordinates it can come lower by what these add alone.
    more = fit_effects(with_family(problem, family), (family.name,), found.fit.x, most_iterations=3)
    assert more.cost <= found.fit.cost * 1.001
    assert with_fine(more, with_family(problem, family), family) is more


def test_a_curve_starts_from_the_fit_without_it_whose_runs_are_known(monkeypatch):
    """Only its own coordinates, and where they lead, are simulated; no start, no nuisance."""
    problem = problem_of(log_of(RigParameters(damping_scale=1.3), seconds=8.0))
    ranges = ranges_of(problem, replay(problem.log))
    family = next(f for f in families(ranges) if f.name == "damping over time")
    base = fit_effects(problem, ())
    simulated = []
    residuals = FitProblem.residuals

    def counted(problem, rigs, **known):
        simulated.extend(rigs)
        return residuals(problem, rigs, **known)

    monkeypatch.setattr(FitProblem, "residuals", counted)
    first_fit(problem, base, family)
    differences = [rig for rig in simulated if rig.stiffness_scale == base_rig(base).stiffness_scale]
    coordinates = len(without_fine(family).effect.parameters)
    assert len(differences) == coordinates  # a step along each


def base_rig(base):
    return base.parameterization.rig(base.x)


def problem_size(problem, family):
    return len(with_family(problem, family).parameterization((family.name,)).parameters)


def begins_somewhere(family):
    """Whether it has few numbers that begin away from no law."""
    parameters = family.effect.parameters
    return len(parameters) <= first_fit_module.FEW_NUMBERS and any(
        set(p.start) != {0.0} for p in parameters
    )


@pytest.mark.parametrize(("promise", "iterations"), [(0.2, 3), (0.01, 1)])
def test_few_numbers_take_several_iterations_where_a_start_promises_something(
    promise, iterations, monkeypatch
):
    problem = problem_of(log_of(RigParameters(damping_scale=1.3), seconds=8.0))
    base = fit_effects(problem, ())
    family = next(f for f in families(ranges_of(problem, replay(problem.log))) if begins_somewhere(f))
    gain, asked = promise * (base.cost - base.samples), []

    def screened(problem, base, name):
        start = problem.parameterization((name,)).joined(base.parts)
        return [Screened(names=(name,), start=start, cost=base.cost - gain, gain=gain)]

    def fitted(*_, most_iterations, near):
        asked.append(most_iterations)
        raise SimulationFailed("asked for")

    monkeypatch.setattr(first_fit_module, "screen", screened)
    monkeypatch.setattr(first_fit_module, "fit_effects", fitted)
    with pytest.raises(SimulationFailed, match="asked for"):
        first_fit(problem, base, family)
    assert asked == [iterations]
