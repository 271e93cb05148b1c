"""A replay is made finer where, and only where, the log asks for it."""

from dataclasses import replace
from functools import cache

import numpy as np
import pandas as pd
import pytest
from diagnosis_fixtures import RIG, fit_of, log_of, log_with, problem_of, scored
from reference_log import BETA, TIP, TORQUE
from reference_rig import Rig as ReferenceRig
from reference_rig import simulate as simulate_reference

from diagnosis.criteria.replay import FINEST_ELEMENTS, FINEST_STEP_S
from diagnosis.criteria.selection import CONTENDING, NEAR_FLOOR
from diagnosis.fitting.fit import fit_effects
from diagnosis.fitting.noise_floor import NoiseFloor
from diagnosis.log.trial import Trial
from diagnosis.replay.resolution import FINE, Resolution
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.candidate import candidate
from diagnosis.selection.record import Decision
from diagnosis.selection.stages import mesh_refinement as module
from diagnosis.selection.stages.mesh_refinement import refined_mesh
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed

ELASTIC = {"stiffness": 0.05, "time_constant": 0.4}
CASES = {"tissue_viscoelasticity": ELASTIC, "damping_error": {"scale": 1.3}}
SIGMA = {"tip_angle_deg": TIP, "base_torque_n_mm": TORQUE, "base_angle_deg": 0.01}


@cache
def problem_with(effect):
    """A needle that turns to and fro while it goes from 100 to 160 mm deep, at 3 mm/s."""
    time = np.arange(0, 20, 0.01)
    lengths = {
        "inserted_mm": 100 + 3 * time,
        "free_mm": 70 - 3 * time,
        "speed_mm_s": np.full(time.size, 3.0),
    }
    base = 240 * np.sin(2 * np.pi * 0.15 * time) ** 2
    rig = ReferenceRig(
        diameter_mm=0.59,
        shear_modulus_gpa=27.2,
        damping_n_mm_s_per_mm=BETA,
        effects={effect: CASES[effect]},
    )
    found = simulate_reference(
        rig, time_s=time, base_angle_deg=base, cells=200, dt=1e-2, slip="material", **lengths
    )
    rng = np.random.default_rng(0)
    table = {
        "time_s": time,
        "base_angle_deg": base,
        "base_torque_n_mm": found.base_torque_n_mm + rng.normal(0, TORQUE, time.size),
        "tip_angle_deg": found.tip_angle_deg + rng.normal(0, TIP, time.size),
    }
    log = log_with(Trial(name="trial_01.csv", table=pd.DataFrame(table | lengths)))
    return problem_of(replace(log, rig=RIG.but(tissue={"damping_n_mm_s_per_mm": BETA})), sigma=SIGMA)


@cache
def usual(effect):
    """The true explanation, fitted by the usual needle."""
    return candidate(fit_effects(problem_with(effect), (effect,)))


@pytest.mark.parametrize(
    ("effect", "asks"), [("tissue_viscoelasticity", True), ("damping_error", False)]
)
@pytest.mark.slow
def test_a_replay_is_as_fine_as_the_log_asks(effect, asks):
    problem, found, record = refined_mesh(problem_with(effect), [usual(effect)], Workers())
    assert (problem.resolution != FINE) is asks
    # A true explanation that the usual needle has to refuse.
    assert usual(effect).floor.reached is not asks
    assert found[0].floor.reached
    made = [e for e in record if e.decision is Decision.MADE]
    assert bool(made) is asks
    assert {e.stage for e in record} <= {module.STAGE}


@pytest.mark.slow
def test_what_is_far_from_explained_is_not_replayed_more_finely():
    problem = problem_with("tissue_viscoelasticity")
    one = problem.log.trials[0]
    ringing = one.readings["tip_angle_deg"] + 10 * TIP * np.sin(2 * np.pi * 2.3 * one.time_s)
    readings = {**one.readings, "tip_angle_deg": ringing}
    log = replace(problem.log, trials=(replace(one, readings=readings),))
    far = replace(problem, log=log)
    before = candidate(fit_effects(far, ("tissue_viscoelasticity",)))
    after, found, record = refined_mesh(far, [before], Workers())
    assert after.resolution == FINE
    assert found[0] is before
    assert record == ()


def small():
    """A problem that no fit is made of."""
    return problem_of(log_of(NOMINAL, seconds=2.0))


def refined(monkeypatch, matters, *, fails=False, candidates=None):
    """What comes of candidates where some resolutions matter; no fit is made."""
    calls = []

    def on_a_finer_mesh(problem, coarser):
        calls.append(coarser.names)
        if fails:
            raise SimulationFailed("lost its numbers")
        return coarser

    monkeypatch.setattr(module, "_matters", lambda problem, best, there: matters(problem, there))
    monkeypatch.setattr(module, "on_a_finer_mesh", on_a_finer_mesh)
    problem = small()
    candidates = candidates or [scored(["tip_drag"], 1.0)]
    return calls, *refined_mesh(problem, candidates, Workers())


def test_elements_and_step_are_refined_to_the_finest_and_no_further(monkeypatch):
    _, problem, _, _ = refined(monkeypatch, lambda problem, there: there != problem.resolution)
    assert problem.resolution == Resolution(elements=FINEST_ELEMENTS, step_s=FINEST_STEP_S)


def test_only_what_matters_is_refined(monkeypatch):
    _, problem, _, _ = refined(
        monkeypatch, lambda problem, there: there.elements == 24 != problem.resolution.elements
    )
    assert problem.resolution == replace(FINE, elements=24)


def test_candidates_that_are_far_behind_and_above_the_noise_are_dropped(monkeypatch):
    above = NoiseFloor(gap=2.0, slow=5.0)
    each = [scored(["tip_drag"], 1.0), scored(["stiction"], 2.0 + CONTENDING, floor=above)]
    calls, _, found, record = refined(
        monkeypatch,
        lambda problem, there: there.elements == 24 != problem.resolution.elements,
        candidates=each,
    )
    assert calls == [("tip_drag",)]
    assert [c.names for c in found] == [("tip_drag",)]
    (out,) = [entry for entry in record if entry.decision is Decision.DROPPED]
    assert (out.effects, out.decision) == (("stiction",), Decision.DROPPED)


def test_where_no_finer_fit_can_be_simulated_the_usual_ones_stand(monkeypatch):
    _, problem, found, _ = refined(monkeypatch, lambda problem, there: True, fails=True)
    assert problem.resolution == FINE
    assert [c.names for c in found] == [("tip_drag",)]


def test_a_resolution_that_cannot_be_simulated_does_not_matter(monkeypatch):
    def failing(*_, **__):
        raise SimulationFailed("lost its numbers")

    problem = small()
    monkeypatch.setattr(type(problem), "residuals", failing)
    found = refined_mesh(problem, [scored(["tip_drag"], 1.0)], Workers())
    assert found[0].resolution == FINE


@pytest.mark.parametrize(("change", "matters"), [(0.09, False), (0.11, True)])
def test_a_change_matters_from_a_tenth_of_the_noise(change, matters):
    white = np.random.default_rng(1).normal(size=4000)
    white /= np.sqrt(np.mean(white**2))
    assert module._is_much(np.full(4000, change), white) is matters
    assert not module._is_much(np.full(4000, change), 2 * white)  # far from explained


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
