"""The stages of the search, and the record that it keeps."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from diagnosis_fixtures import concluded, fit_of, log_of, scored, start_of_search

from diagnosis.criteria import NEAR_FLOOR, SIMPLE_LEAD
from diagnosis.effects import FITTED, LIBRARY
from diagnosis.fitting.cross_validation import information
from diagnosis.fitting.fit import fit_effects
from diagnosis.fitting.fit_status import FitStatus, Termination
from diagnosis.fitting.noise_reestimation import rescaled
from diagnosis.prepare.noise.noise_colour import NoiseColour
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.selection import fitting
from diagnosis.selection import search as module
from diagnosis.selection.candidate import candidate
from diagnosis.selection.record import Decision
from diagnosis.selection.search import STAGES, search
from diagnosis.selection.state import SearchState
from diagnosis.selection.verdict import VerdictKind
from diagnosis.workers import Workers
from sim.simulation import SimulationFailed

EFFECTS = ("coulomb_friction", "tip_drag", "torque_bias")


@pytest.fixture(scope="module")
def dry_start():
    return start_of_search(
        log_of(RigParameters(kinetic_n_mm_per_mm=0.001), speed=-1.0, seconds=8.0), EFFECTS
    )


@pytest.fixture(scope="module")
def still_start():
    return start_of_search(log_of(NOMINAL, speed=-1.0, seed=1), EFFECTS)


@pytest.fixture(scope="module")
def undisturbed(dry_start):
    return search(dry_start, Workers())


def failing(*_, **__):
    """What cannot be simulated at all."""
    raise SimulationFailed("the simulation lost its numbers")


def test_the_stages_are_these_in_this_order():
    assert [stage.__name__ for stage in STAGES] == [
        "nominal_rig",
        "stiffness_or_damping_alone",
        "single_effects",
        "coloured_noise",
        "finer_mesh_near_the_floor",
        "pairs",
        "richer_effects",
        "one_more_imperfection",
        "best_to_its_end",
        "effects_of_the_best_alone",
        "scatter_of_the_best",
        "finer_mesh",
    ]


def test_each_stage_goes_on_from_the_last(monkeypatch, dry_start):
    def counted(name, state, _):
        return state.noting(name)

    stages = tuple(partial(counted, stage.__name__) for stage in STAGES)
    monkeypatch.setattr(module, "STAGES", stages)
    monkeypatch.setattr(module, "with_drift", lambda state, *_: state)
    assert search(dry_start, Workers()).record == tuple(stage.__name__ for stage in STAGES)


@pytest.mark.slow
def test_dry_friction_is_found_among_others(undisturbed):
    verdict = concluded(undisturbed)
    assert (verdict.kind, verdict.effects) == (VerdictKind.EXPLAINED, ("coulomb_friction",))


@pytest.mark.slow
def test_every_candidate_was_made_by_a_stage_of_the_record(undisturbed):
    told = {(e.effects, e.decision) for e in undisturbed.record}
    for one in undisturbed.candidates:
        made = {(one.names, Decision.MADE), (one.names, Decision.KEPT)}
        assert made & told


@pytest.mark.slow
def test_an_effect_that_cannot_be_simulated_is_recorded_and_changes_nothing_else(dry_start, undisturbed):
    library = {**LIBRARY, "tip_drag": replace(LIBRARY["tip_drag"], apply=failing)}
    lame = {name: replace(getattr(dry_start, name), library=library) for name in ("problem", "coarse")}
    found = search(replace(dry_start, **lame), Workers())
    lost = [e for e in found.record if e.decision is Decision.FAILED]
    assert lost
    assert all("tip_drag" in e.effects for e in lost)
    assert all(e.reason == "the simulation lost its numbers" for e in lost)
    assert lost[0].stage == "single effects"
    assert concluded(found).effects == concluded(undisturbed).effects
    assert concluded(found).best.score == concluded(undisturbed).best.score


def test_where_the_scatter_cannot_be_fitted_the_nominal_rig_still_stands(still_start, monkeypatch):
    original = fitting.fit_effects

    def without_scatter(problem, names, *arguments):
        return original(problem, names, *arguments) if names else failing()

    monkeypatch.setattr(fitting, "fit_effects", without_scatter)
    found = search(still_start, Workers())
    assert [e.effects for e in found.record if e.decision is Decision.FAILED] == [()]
    verdict = concluded(found)
    assert verdict.kind is VerdictKind.NONE
    assert verdict.best.fit is not None
    assert verdict.best.names == ()


@pytest.mark.parametrize(
    ("start", "kind"), [("still_start", VerdictKind.NONE), ("dry_start", VerdictKind.UNKNOWN)]
)
def test_where_nothing_can_be_fitted_the_verdict_is_on_the_nominal_rig(
    start, kind, request, monkeypatch
):
    for owner in (fitting, module):
        monkeypatch.setattr(owner, "fit_effects", failing)
    found = search(request.getfixturevalue(start), Workers())
    assert [c.names for c in found.candidates] == [()]
    assert concluded(found).kind is kind
    assert {e.stage for e in found.record if e.decision is Decision.FAILED} >= {
        "nominal rig",
        "single effects",
    }


def test_the_scatter_is_dropped_where_the_exact_nominal_rig_is_as_good(still_start):
    found = module.nominal_rig(still_start, Workers())
    assert [c.fit for c in found.candidates] == [still_start.nominal]
    decisions = [e.decision for e in found.record]
    assert decisions == [Decision.KEPT, Decision.MADE, Decision.DROPPED]
    assert "exact nominal rig" in found.record[-1].reason


def test_stiffness_or_damping_alone_is_fitted_where_their_ratio_shows(monkeypatch, still_start):
    asked = []

    def fit_each_alone(stage, problem, one, names, workers):
        asked.append(tuple(names))
        return [], ()

    monkeypatch.setattr(module, "fit_each_alone", fit_each_alone)
    clear = scored(["tip_drag"], 1.0)
    module.stiffness_or_damping_alone(replace(still_start, candidates=(clear,)), Workers())
    assert asked == []
    ratio = type("Ratio", (), {"unidentifiable": True})()
    module.stiffness_or_damping_alone(replace(still_start, candidates=(ratio,)), Workers())
    assert asked == [("stiffness_error", "damping_error")]


def test_each_effect_of_a_leading_pair_is_fitted_alone(monkeypatch, still_start):
    asked = []

    def fit_each_alone(stage, problem, one, names, workers):
        asked.append((stage, tuple(names)))
        return [], ()

    monkeypatch.setattr(module, "fit_each_alone", fit_each_alone)
    single, pair = scored(["tip_drag"], 2.0), scored(["tip_drag", "torque_bias"], 1.0)
    module.effects_of_the_best_alone(replace(still_start, candidates=(single,)), Workers())
    assert asked == []
    module.effects_of_the_best_alone(replace(still_start, candidates=(single, pair)), Workers())
    assert asked == [("effects of the best alone", ("tip_drag", "torque_bias"))]


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


@pytest.mark.parametrize(
    ("gap", "finer"), [(0.99 * NEAR_FLOOR**0.5, True), (1.01 * NEAR_FLOOR**0.5, False)]
)
def test_what_is_far_above_the_floor_gets_no_finer_mesh_before_pairs(
    gap, finer, monkeypatch, still_start
):
    asked = []
    monkeypatch.setattr(module, "finer_mesh", lambda state, _: asked.append(state) or state)
    fit = fit_of(("tip_drag",), by_trial=[np.full(10, gap)])
    state = replace(still_start, candidates=(replace(scored(["tip_drag"], 1.0), fit=fit),))
    assert module.finer_mesh_near_the_floor(state, Workers()) is state
    assert bool(asked) is finer


FALLING = RigParameters(kinetic_n_mm_per_mm=0.001, static_excess_n_mm_per_mm=0.0025, stribeck_rad_s=0.8)
"""Dry friction that falls by more than half between the slow and the fast turns of a trial."""


@pytest.fixture(scope="module")
def taken_for_constant():
    """A log with friction that falls with the rate, for which constant friction was found alone."""
    start = start_of_search(log_of(FALLING, seconds=8.0), ("coulomb_friction", "stiction"))
    fit = fit_effects(start.coarse, ("coulomb_friction",), np.array([np.log(0.002), 0, 0]))
    return replace(start, candidates=(candidate(start.nominal),), singles=(candidate(fit),))


@pytest.mark.slow
def test_what_contains_the_best_is_fitted_from_there(taken_for_constant):
    (simple,) = taken_for_constant.singles
    found = module.richer_effects(taken_for_constant, Workers())
    assert [c.names for c in found.candidates] == [(), ("stiction",)]
    assert found.pairs[0].score < simple.score - 10 * SIMPLE_LEAD
    assert found.best.floor.small
    fit = found.best.fit
    sigma = np.sqrt(np.linalg.pinv(information(fit))[0, 0])
    assert abs(fit.x[0] - np.log(0.001)) < 4 * sigma


def test_no_richer_effect_is_fitted_where_none_contains_a_leading_one(taken_for_constant):
    without = replace(taken_for_constant, effects=("coulomb_friction", "tip_drag"))
    assert module.richer_effects(without, Workers()) is without


def test_no_richer_effect_is_fitted_where_something_explains_the_log(taken_for_constant, monkeypatch):
    monkeypatch.setattr(SearchState, "rechecked", lambda state: (state, True))
    assert module.richer_effects(taken_for_constant, Workers()) is taken_for_constant


@pytest.mark.slow
def test_a_constant_that_the_best_names_is_fitted_without_its_prior():
    off = start_of_search(log_of(RigParameters(stiffness_scale=1.2), speed=-1.0, seconds=8.0), ())
    found = search(off, Workers())
    (entry,) = [e for e in found.record if e.stage == "scatter of the best"]
    assert entry.effects == ("stiffness_error",)
    best = concluded(found)
    assert best.effects == ("stiffness_error",)
    assert np.exp(best.best.fit.parts["stiffness_error"][0]) == pytest.approx(1.2, rel=0.01)


def test_the_record_of_a_whole_search_tells_who_made_what_and_why_others_are_out(dry):
    record = dry.found.record
    own = [(e.stage, e.decision) for e in record if e.effects == ("coulomb_friction",)]
    assert own == [
        ("single effects", Decision.MADE),
        ("finalists", Decision.MADE),
        ("verdict", Decision.KEPT),
    ]
    stages = list(dict.fromkeys(e.stage for e in record))
    search = ["nominal rig", "single effects", "finalists", "pairs", "finalists, pairs"]
    assert stages == [*search, "verdict"]
    out = {e.effects: e for e in record if e.decision is Decision.DROPPED}
    assert out[()].reason.startswith("above the noise floor")
    assert "far above what is at the noise floor" in out["tip_drag",].reason
    assert out["tip_drag",].score is None
    assert out["coulomb_friction", "tip_drag"].reason == "screening promises too little"
    made = [e for e in record if e.decision is Decision.MADE]
    assert all(e.reason.startswith("Terminated after ") for e in made)
    assert not [e for e in record if e.decision is Decision.FAILED]


def test_every_effect_that_may_be_tried_is_in_the_record(dry):
    testable = {name for name, effect in FITTED.items() if effect.needs != "tip_torque_n_mm"}
    assert {e.effects[0] for e in dry.found.record if len(e.effects) == 1} == testable


def test_a_search_begins_again_where_the_best_effect_leaves_another_colour(dry_start, monkeypatch):
    """Noise that was taken for coloured beside dry friction, and is white once that is known."""
    sigma = dry_start.problem.noise.sigma
    colour = {"tip_angle_deg": NoiseColour(share=0.5, correlation_time_s=0.1)}
    noise = replace(dry_start.problem.noise, colour=colour)
    start = replace(
        dry_start,
        effects=("coulomb_friction",),
        nominal=rescaled(dry_start.nominal, dry_start.problem, noise),
        problem=replace(dry_start.problem, noise=noise),
        coarse=replace(dry_start.coarse, noise=replace(dry_start.coarse.noise, colour=colour)),
    )
    monkeypatch.setattr(module, "with_colour", lambda problem, _: replace(problem.noise, colour={}))
    begun = module.single_effects(module.nominal_rig(start, Workers()), Workers())
    again = module.coloured_noise(begun, Workers())
    assert again.problem.noise.colour == again.coarse.noise.colour == {}
    assert again.problem.noise.sigma == sigma
    np.testing.assert_allclose(again.nominal.by_trial[0], dry_start.nominal.by_trial[0], atol=1e-9)
    dropped = [e for e in again.record if e.stage == "coloured noise"]
    assert [e.effects for e in dropped] == [c.names for c in begun.candidates]
    # Where the colours are the same, nothing is done.
    assert module.coloured_noise(again, Workers()) is again


def test_where_the_same_noise_is_coloured_otherwise_fits_are_kept_in_its_units(undisturbed):
    colour = {"tip_angle_deg": NoiseColour(share=0.5, correlation_time_s=0.1)}
    noise = replace(undisturbed.problem.noise, colour=colour)
    again = undisturbed.renoised(noise)
    best = undisturbed.best
    left = again.problem.residuals([best.fit.parameterization.rig(best.fit.x)])
    (same,) = (c for c in again.candidates if c.names == best.names)
    np.testing.assert_allclose(same.fit.by_trial[0], left[0][0], atol=1e-9)
    assert len(again.singles) == len(undisturbed.singles)
