"""A fitted explanation: what it names, and whether it explains the log."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import fit_of, joined, log_of, problem_of, scored

from diagnosis.criteria.fitting import SCATTER, SCATTER_ALIKE, SCATTER_NAMED
from diagnosis.criteria.selection import HELD_OUT_GAP, SHIFT_LIMIT
from diagnosis.effects import LIBRARY
from diagnosis.fitting.fit import fit_effects
from diagnosis.fitting.fit_status import FitStatus, Termination
from diagnosis.fitting.noise_floor import NoiseFloor
from diagnosis.fitting.parameterization import parameterization_of
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.selection import candidate as module
from diagnosis.selection.candidate import candidate
from diagnosis.selection.scoring.complexity import complexity_penalty
from sim.needles.run import SimulationFailed

SCALES = tuple(LIBRARY[name] for name in SCATTER)
DRY = RigParameters(kinetic_n_mm_per_mm=0.001)


def fitted(other):
    """Dry friction, fitted to a trial that has it and to another that may not."""
    problem = problem_of(joined(log_of(DRY, speed=-1.0), log_of(other, seed=4, speed=-1.0)))
    fit = fit_effects(problem, ("coulomb_friction",), np.array([np.log(0.001), 0, 0, 0]))
    return problem, candidate(fit).cross_validated(problem)


@pytest.fixture(scope="module")
def same():
    return fitted(DRY)


def test_an_explanation_that_holds_where_it_was_not_fitted_explains(same):
    _, good = same
    assert 0 < good.shift < 9
    assert good.held_out_floor.reached
    assert good.explains


def test_an_explanation_that_does_not_hold_where_it_was_not_fitted_does_not():
    """Friction in one trial and none in the other: no level explains both."""
    problem, inconsistent = fitted(NOMINAL)
    assert module.shift_statistic(inconsistent.fit) > 9
    assert not inconsistent.explains
    # Even if its residual were at the floor, its trials tell different levels.
    assert not replace(inconsistent, floor=NoiseFloor(gap=1, slow=1)).cross_validated(problem).explains


def test_what_cannot_be_simulated_without_a_trial_is_said_and_explains_nothing(same, monkeypatch):
    problem, good = same

    def failing(*_):
        raise SimulationFailed("lost its numbers")

    monkeypatch.setattr(module, "held_out_or_refitted", failing)
    checked = candidate(good.fit).cross_validated(problem)
    assert checked.held_out_failure == "lost its numbers"
    assert checked.held_out is None
    assert not checked.explains


def test_what_is_far_off_on_held_out_trials_explains_nothing(same):
    _, good = same
    off = replace(good, held_out_floor=good.held_out_floor.times(1.01 * HELD_OUT_GAP))
    assert not off.explains
    assert "held-out trials are" in off.objection
    assert replace(good, held_out_floor=good.held_out_floor.times(0.9 * HELD_OUT_GAP)).explains


def test_what_is_above_the_floor_is_not_simulated_on_held_out_trials(monkeypatch):
    monkeypatch.setattr(module, "held_out_or_refitted", pytest.fail)
    above = scored(["tip_drag"], 1.0, floor=NoiseFloor(gap=2, slow=2), held_out=None)
    assert above.cross_validated(None) is above


def test_the_score_is_the_cost_and_the_penalty():
    fit = fit_of(("tip_drag",), by_trial=np.ones((2, 50)))
    assert candidate(fit).score == pytest.approx(100 + complexity_penalty(fit))


@pytest.mark.parametrize(("shift", "explains"), [(SHIFT_LIMIT, True), (SHIFT_LIMIT + 0.1, False)])
def test_trials_that_shift_too_far_are_not_explained(shift, explains):
    assert scored(["tip_drag"], 1.0, shift=shift).explains is explains


@pytest.mark.parametrize(
    ("bound", "explains"),
    [
        ("layered_tissue.boundary", False),
        ("shear_thinning.plateau", True),  # of which nothing is told
        ("tip_clock.rate", True),  # an imperfection of a sensor
        ("stiffness_error.scale", True),  # not among its effects
    ],
)
def test_what_needs_a_parameter_at_a_bound_is_another_law(bound, explains):
    names = ("layered_tissue", "shear_thinning", "tip_clock")
    status = FitStatus(termination=Termination.GRADIENT, message="", at_bound=(bound,))
    one = replace(scored(["tip_drag"], 1.0), fit=fit_of(names, status=status))
    assert one.explains is explains
    assert ("bound" in one.objection) is not explains
    told = bound not in ("shear_thinning.plateau", "stiffness_error.scale")
    assert one.told_at_bound == ((bound,) if told else ())


def off_by(stiffness, damping, *, names=(), slopes=(1e3, 0.0)):
    """A candidate whose constants are off so far, and how sharply a log shows it."""
    first = [[0.0]] * 10 if names else [[]] * 10
    rows = np.hstack([np.array(first), np.tile(slopes, (10, 1))])
    x = np.array([*([-3.0] if names else []), stiffness, damping])
    return replace(scored(names, 1.0), fit=fit_of(names, x=x, jacobian=[rows], nuisance=SCALES))


def test_a_constant_that_is_off_for_certain_is_named_alone():
    assert off_by(0.05, 0.0).named == ("stiffness_error",)
    assert off_by(0.05, 0.0, slopes=(10.0, 0.0)).named == ()  # 3 % of standard error
    assert off_by(0.002, 0.0).named == ()  # certain, and less than two simulations differ by


def test_beside_an_imperfection_of_a_sensor_a_constant_is_named_as_alone():
    """A clock that drifts is no reason to doubt a stiffness that is off for certain."""
    off = off_by(0.022, 0.0, names=("tip_clock",))
    assert off.named == ("stiffness_error",)
    assert off_by(0.002, 0.0, names=("tip_clock",)).named == ()
    assert off_by(0.022, 0.0, names=("tip_drag",)).named == ("tip_drag",)


@pytest.mark.parametrize("sign", [-1, 1])
def test_beside_an_effect_a_constant_is_named_beyond_its_scatter(sign):
    """The scatter is a fraction of the constant, whose logarithm is fitted."""
    for share, named in ((1.005, ("stiffness_error",)), (0.995, ())):
        off = np.log1p(sign * share * SCATTER_NAMED * SCATTER["stiffness_error"])
        assert off_by(off, 0.0, names=("tip_drag",)).named == ("tip_drag", *named)


@pytest.mark.parametrize(
    ("damping", "slope", "named"),
    [
        (0.029, 1e3, True),
        (0.024, 1e3, False),  # together they are off by 2.54 standard deviations, more than is asked
        (-0.029, 1e3, False),
        (0.029, 30.0, False),
    ],
    ids=["alike", "not alike", "in opposite directions", "alike, as far as little tells"],
)
def test_constants_that_are_off_alike_are_named_before_either_alone_would_be(damping, slope, named):
    """As a torque gain would make them, which is likelier than both by chance."""
    rows = np.tile([[0.0, slope, 0.0], [0.0, 0.0, slope]], (10, 1))
    fit = fit_of(("tip_drag",), x=np.array([-3.0, 0.029, damping]), jacobian=[rows], nuisance=SCALES)
    one = replace(scored(["tip_drag"], 1.0), fit=fit)
    assert one.named == ("tip_drag", *(SCATTER if named else ()))


@pytest.mark.parametrize(("share", "named"), [(0.99, ()), (1.01, tuple(SCATTER))])
def test_constants_that_are_off_alike_by_little_are_scatter(share, named):
    off = np.log1p(share * SCATTER_ALIKE / np.sqrt(2.0) * SCATTER["stiffness_error"])
    rows = np.tile([[0.0, 1e3, 0.0], [0.0, 0.0, 1e3]], (10, 1))
    fit = fit_of(("tip_drag",), x=np.array([-3.0, off, off]), jacobian=[rows], nuisance=SCALES)
    assert replace(scored(["tip_drag"], 1.0), fit=fit).named == ("tip_drag", *named)


def test_a_ratio_that_is_off_does_not_say_which_constant_is():
    """Slopes of stiffness and damping that are opposite: their ratio alone shows."""
    ratio = off_by(0.02, -0.02, slopes=(1e3, -1e3))
    assert ratio.jointly_significant
    assert ratio.unidentifiable
    assert not ratio.explains
    told = off_by(0.05, 0.0)
    assert told.jointly_significant
    assert not told.unidentifiable


def test_stiffness_or_damping_alone_are_scatter():
    assert scored(["stiffness_error"], 1.0).only_scatter
    assert not scored(["stiffness_error", "tip_drag"], 1.0).only_scatter
    assert not scored([], 1.0).only_scatter


ABOVE = NoiseFloor(gap=1.05, slow=1.0)
SLOW = NoiseFloor(gap=1.0, slow=1.4)


@pytest.mark.parametrize(
    ("known", "reason"),
    [
        ({}, ""),
        ({"floor": ABOVE}, "above the noise floor: residual 1.050 σ, limit 1.030"),
        ({"floor": SLOW}, "not white: slow part 1.400 σ, limit 1.250"),
        ({"held_out": None}, "held-out trials cannot be simulated: not tried"),
        ({"held_out": None, "held_out_failure": "lost"}, "held-out trials cannot be simulated: lost"),
        (
            {"shift": 20.2},
            (
                "predictions of held-out trials shift by 20.2 times what the uncertainty of the "
                "parameters makes it, limit 12"
            ),
        ),
    ],
)
def test_what_does_not_explain_the_log_says_why(known, reason):
    one = scored(["tip_drag"], 1.0, **known)
    assert one.objection == reason
    assert one.explains is (reason == "")


def test_all_that_speaks_against_it_is_told_first_things_first():
    alone = [scored(["tip_drag"], 1.0, **known) for known in ({"floor": ABOVE}, {"shift": 20.2})]
    both = scored(["tip_drag"], 1.0, floor=ABOVE, shift=20.2)
    assert both.objections == "; ".join(one.objection for one in alone)
    assert both.objection == alone[0].objection
    assert scored(["tip_drag"], 1.0).objections == ""


@pytest.mark.parametrize("floor", [ABOVE, SLOW], ids=["above the noise", "not white"])
def test_above_the_floor_it_is_no_objection_that_held_out_trials_were_not_tried(floor):
    tried = scored(["tip_drag"], 1.0, floor=floor)
    assert replace(tried, held_out=None).objections == tried.objection


@pytest.mark.parametrize(("exponent", "explains"), [(1.002, False), (0.995, False), (0.98, True)])
def test_an_exponent_of_nearly_one_is_no_shear_thinning(exponent, explains):
    """It took off what hardening tissue leaves beside elastic tissue, with an exponent of 1.002."""
    parameterization = parameterization_of(["shear_thinning"])
    x = np.array([exponent, np.log(0.003)])
    one = scored(["shear_thinning"], 1.0)
    one = replace(one, fit=replace(one.fit, parameterization=parameterization, x=x))
    assert one.explains is explains
    assert ("as good as none: shear_thinning.exponent" in one.objection) is not explains


def test_what_is_slow_beside_coloured_noise_explains_nothing(same):
    _, good = same
    slow = NoiseFloor(gap=1.0, slow=1.8, slow_limit=1.4)
    assert good.coloured == {}
    held = replace(good, coloured={"tip_angle_deg": slow})
    assert not held.explains
    assert held.objection == (
        "tip_angle_deg, averaged over seconds, is off by 1.80 times what its noise makes it, limit 1.40"
    )
    assert replace(good, coloured={"tip_angle_deg": replace(slow, slow=1.3)}).explains
