"""The nearest explanation: what it explains, and what stopped at a bound."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from diagnosis_fixtures import fit_of, scored

from diagnosis.assessment import nearest as module
from diagnosis.assessment.gap_reduction import GapReduction
from diagnosis.assessment.nearest import nearest_of
from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.effects import LIBRARY
from diagnosis.fitting.fit_status import FitStatus, Termination
from diagnosis.fitting.noise_floor import floor_of
from diagnosis.selection.verdicts.verdict import VerdictKind
from diagnosis.workers import Workers

LEVEL = Interval(value=1.0, low=0.9, high=1.1, unit="N mm / mm")
PARAMETERS = {"coulomb_friction": {"level": LEVEL}, "damping_error": {"scale": LEVEL}}


def gap(before, after):
    return GapReduction(before=before, after=after, shrink=0.0, shrink_low=0.0, shrink_high=0.0)


@pytest.mark.parametrize(
    ("before", "after", "percent"),
    [(11.0, 1.0, 100.0), (11.0, 11.0, 0.0), (3.0, 2.0, 62.5), (11.0, 12.0, 0.0), (0.9, 0.9, 0.0)],
)
def test_power_explained_is_that_beyond_noise(before, after, percent):
    best = scored(("coulomb_friction",), 0.0)
    near = nearest_of(best, ("coulomb_friction",), PARAMETERS, gap(before, after))
    assert near.power_explained_percent == pytest.approx(percent)
    assert near.gap_after == after


def test_it_tells_the_parameters_of_its_effects_and_what_stopped_at_a_bound():
    best = scored(("coulomb_friction",), 0.0)
    held = ("coulomb_friction.level", "damping_error.scale")
    status = FitStatus(termination=Termination.STEP, message="", at_bound=held)
    best = replace(best, fit=replace(best.fit, status=status))
    near = nearest_of(best, ("coulomb_friction",), PARAMETERS, gap(5.0, 2.0))
    assert near.parameters == {"coulomb_friction": {"level": LEVEL}}
    assert near.at_bound == ("coulomb_friction.level",)


def test_a_constant_of_the_rig_at_its_bound_and_what_the_sensors_do_are_told():
    names = ("coulomb_friction", "torque_clock")
    fit = fit_of(names, nuisance=(LIBRARY["damping_error"],))
    least = fit.parameterization.bounds()[0][-1]
    fit = replace(fit, x=np.append(fit.x[:-1], least))
    best = replace(scored(names, 0.0), fit=fit)
    near = nearest_of(best, ("coulomb_friction", "damping_error"), PARAMETERS, gap(5.0, 2.0))
    assert near.at_bound == ("damping_error.scale",)
    assert near.imperfections == ("torque_clock",)


@pytest.mark.parametrize(("left", "effects"), [(0.9, ("tip_drag",)), (1.1, ())])
def test_what_leaves_more_on_held_out_trials_than_the_nominal_rig_is_not_nearest(
    left, effects, monkeypatch
):
    """Trials that a fit has not seen may tell another story than those that it has."""
    before = (np.full(50, 4.0), np.full(50, 3.0))
    best = replace(scored(["tip_drag"], 0.0), held_out=tuple(left * own for own in before))
    monkeypatch.setattr(module, "forward_selection", lambda problem, coarse, fit, *_: fit)
    monkeypatch.setattr(module, "nominal_residuals", lambda *_: before)
    two = SimpleNamespace(log=SimpleNamespace(trials=("one", "two")))
    unknown = SimpleNamespace(kind=VerdictKind.UNKNOWN, best=best)
    near, after, _ = module.nearest_candidate(two, None, (), unknown, object, (), Workers())
    assert near.names == effects
    assert floor_of(after).gap == pytest.approx(min(left, 1.0) * np.sqrt(12.5))
