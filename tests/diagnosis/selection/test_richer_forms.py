"""Forms of a richer effect about the simpler one that it contains."""

import numpy as np
from diagnosis_fixtures import fit_of, log_of, problem_of, scored

from diagnosis.effects import LIBRARY
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.richer_forms import forms_beyond, overlap, with_richer


def test_forms_stand_about_the_simpler_law_and_leave_all_else_as_it_is():
    problem = problem_of(log_of(RigParameters()))
    names = ("tip_drag", "coulomb_friction")
    one = scored(names, 1.0)
    x = problem.parameterization(names).joined(
        {"tip_drag": np.array([-2.0]), "coulomb_friction": np.log([1e-3]), "damping_error": [0.02]}
    )
    fit = fit_of(names, x=x, nuisance=problem.nuisance)
    one = type(one)(fit=fit, score=1.0, floor=one.floor)
    assert with_richer(one, "coulomb_friction", "stiction") == ("tip_drag", "stiction")
    found = forms_beyond(problem, one, "coulomb_friction", "stiction")
    wanted = LIBRARY["stiction"].contains["coulomb_friction"](1e-3)
    parameterization = problem.parameterization(("tip_drag", "stiction"))
    assert len(found) == len(wanted)
    for form, values in zip(found, wanted, strict=True):
        parts = parameterization.parts(form)
        np.testing.assert_allclose(np.exp(parts["stiction"]), values)
        assert parts["tip_drag"] == -2.0
        assert parts["damping_error"] == 0.02
        kinetic, static, _ = values
        assert kinetic < 1e-3 < static  # it falls through the level of the simpler law


def test_a_law_beside_one_that_it_contains_adds_nothing_new():
    assert overlap("stiction", ("coulomb_friction", "tip_drag"))
    assert overlap("coulomb_friction", ("stiction",))
    assert overlap("tip_drag", ("tip_drag",))
    assert not overlap("tip_drag", ("stiction", "coulomb_friction"))
