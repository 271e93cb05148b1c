"""The name of dry friction where a needle never slides."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import fit_of, log_of, problem_of, verdict_of

from diagnosis.fitting.fit import fit_effects
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.candidate import candidate
from diagnosis.selection.verdicts.plainly_named import plainly_named
from diagnosis.selection.verdicts.verdict import VerdictKind

SHARED = ("torque_bias", "speed_dependent_friction")


@pytest.fixture(scope="module", params=[0.0, -1.0])
def problem(request):
    return problem_of(log_of(NOMINAL, speed=request.param, seconds=4.0))


def unknown(problem, names=SHARED):
    parameterization = problem.parameterization(names)
    x = parameterization.joined({"speed_dependent_friction": np.array([-6.0])})
    best = candidate(fit_effects(problem, names, x, most_iterations=1))
    return replace(verdict_of((["tip_drag"], 1.0)), kind=VerdictKind.UNKNOWN, effects=(), best=best)


def test_friction_that_is_shared_with_a_motion_that_is_not_there_is_plain(problem):
    found = plainly_named(unknown(problem), problem)
    slides = problem.log.trials[0].slides
    assert found.best.names == (SHARED if slides else ("torque_bias", "coulomb_friction"))


def test_the_plain_law_leaves_what_the_other_left(problem):
    fit = plainly_named(unknown(problem), problem).best.fit
    (left,) = (each[0] for each in problem.residuals([fit.parameterization.rig(fit.x)]))
    assert left == pytest.approx(fit.by_trial[0], abs=1e-9)


def test_a_verdict_that_names_effects_stands(problem):
    told = replace(unknown(problem), kind=VerdictKind.EXPLAINED)
    assert plainly_named(told, problem) is told


@pytest.mark.parametrize("names", [("torque_bias",), ("coulomb_friction", "speed_dependent_friction")])
def test_what_has_no_such_friction_or_both_stands(names, problem):
    best = candidate(fit_of(names))
    told = replace(unknown(problem), best=best)
    assert plainly_named(told, problem) is told
