"""The stages of the search, and the record that it keeps."""

import re
from dataclasses import replace
from functools import partial

import pytest
from diagnosis_fixtures import concluded

from diagnosis.effects import FITTED, LIBRARY
from diagnosis.selection import fitting
from diagnosis.selection import search as module
from diagnosis.selection.record import Decision
from diagnosis.selection.search import STAGES, search
from diagnosis.selection.stages import single_effects
from diagnosis.selection.verdicts.verdict import VerdictKind
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed


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
        "stiffness_or_damping_alone",
        "richer_effects",
        "flicker_noise_that_shows",
        "pairs",
        "richer_effects",
        "imperfections_of_sensors",
        "stiffness_or_damping_alone",
        "flicker_noise_that_shows",
        "presliding_of_dry_friction",
        "three_effects",
        "richer_effects_in_place_of_three",
        "exchanges",
        "imperfections_beside_three",
        "exchanges_in_the_best",
        "presliding_of_dry_friction",
        "best_to_its_end",
        "noise_of_the_best",
        "imperfections_in_place",
        "best_without_each_effect",
        "richer_effects_in_the_best",
        "scatter_of_the_best",
        "flicker_noise_that_shows",
        "finer_mesh",
        "tissue_that_goes_along",
        "starts_of_trials",
        "clocks_before_trials",
        "noise_that_grows",
        "noise_of_each_trial",
        "outliers_beside_the_best",
        "weakly_coloured_noise",
        "flicker_noise",
        "drift_of_the_torque_sensor",
        "jumps_of_readings",
        "drift_of_the_tip_sensor",
        "starts_and_another_imperfection",
        "outliers_and_another_imperfection",
        "drift_or_offset",
        "scatter_of_the_best",
        "finer_mesh",
        "simpler_effects",
        "imperfections_in_place",
        "best_without_each_effect",
        "plainer_sets",
    ]


def test_each_stage_goes_on_from_the_last(monkeypatch, dry_start):
    def counted(name, state, _):
        return state.noting(name)

    stages = tuple(partial(counted, stage.__name__) for stage in STAGES)
    monkeypatch.setattr(module, "STAGES", stages)
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


@pytest.mark.parametrize(
    ("start", "kind"), [("still_start", VerdictKind.NONE), ("dry_start", VerdictKind.UNKNOWN)]
)
def test_where_nothing_can_be_fitted_the_verdict_is_on_the_nominal_rig(
    start, kind, request, monkeypatch
):
    for owner in (fitting, single_effects):
        monkeypatch.setattr(owner, "fit_effects", failing)
    found = search(request.getfixturevalue(start), Workers())
    assert [c.names for c in found.candidates] == [()]
    assert concluded(found).kind is kind
    assert {e.stage for e in found.record if e.decision is Decision.FAILED} >= {
        "nominal rig",
        "single effects",
    }


def test_the_record_of_a_whole_search_tells_who_made_what_and_why_others_are_out(dry):
    record = dry.found.record
    own = [(e.stage, e.decision) for e in record if e.effects == ("coulomb_friction",)]
    assert own == [
        ("single effects", Decision.MADE),
        ("finalists", Decision.MADE),
        ("verdict", Decision.KEPT),
    ]
    stages = list(dict.fromkeys(e.stage for e in record))
    search = ["nominal rig", "single effects", "finalists", "pairs"]
    assert stages == [*search, "verdict"]
    out = {e.effects: e for e in record if e.decision is Decision.DROPPED}
    assert out[()].reason.startswith("above the noise floor")
    assert "far above what is at the noise floor" in out["tip_drag",].reason
    assert out["tip_drag",].score is None
    assert out["coulomb_friction", "tip_drag"].reason == "screening promises too little"
    made = [e for e in record if e.decision is Decision.MADE]
    assert all(re.match(r"(converged|ended|given up) after \d+ iteration", e.reason) for e in made)
    assert not [e for e in record if e.decision is Decision.FAILED]


def test_every_effect_that_may_be_tried_is_in_the_record(dry):
    testable = {name for name, effect in FITTED.items() if effect.needs != "tip_torque_n_mm"}
    assert {e.effects[0] for e in dry.found.record if len(e.effects) == 1} == testable
