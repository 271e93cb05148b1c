"""The presliding angle of dry friction: fitted where that leads, and where the log asks for it."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import joined, log_of, start_of_search

from diagnosis.freeform.other_form import other_form
from diagnosis.nominal_replay import replay_nominal
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.fitting import fit_all
from diagnosis.selection.record import Decision, RecordEntry
from diagnosis.selection.stages.laws import presliding
from diagnosis.selection.stages.laws.presliding import STAGE, presliding_of_dry_friction
from diagnosis.selection.stages.single_effects import single_effects
from diagnosis.workers import Failure, Workers
from sim.discretisation import PRESLIDING_DEG

LEVEL = 0.006


def log_with_presliding(rig):
    return joined(*(log_of(rig, seed=seed, seconds=8.0) for seed in (1, 2)))


def searched(**changes):
    """Before and after the stage, of two trials."""
    rig = RigParameters(**changes)
    log = log_with_presliding(rig)
    effects = ("coulomb_friction", "tip_drag")
    state = single_effects(start_of_search(log, effects=effects), Workers())
    state = state.adding(fit_all("other", [(state.problem, ("tip_drag",))], Workers()))
    return state, presliding_of_dry_friction(state, Workers())


def told(state):
    return [said for said in state.problem.log.warnings if "before it slides" in said]


@pytest.fixture(scope="module")
def early():
    """Dry friction that gives by three times the usual angle."""
    return searched(kinetic_n_mm_per_mm=LEVEL, presliding_deg=0.3)


def test_another_angle_is_found_and_told(early):
    before, after = early
    assert after.problem.log.presliding_deg == pytest.approx(0.3, rel=0.1)
    assert after.coarse.log.presliding_deg == after.problem.log.presliding_deg
    assert told(after) == [
        f"dry friction is taken to give by {after.problem.log.presliding_deg:.3g} deg before it "
        "slides, not by the usual 0.1 deg"
    ]
    assert not told(before)
    assert [e.decision for e in after.record if e.stage == STAGE and not e.effects][-1] is Decision.KEPT


def test_with_it_dry_friction_leaves_less_and_has_its_level(early):
    before, after = early
    assert after.best.names == before.best.names == ("coulomb_friction",)
    assert after.best.fit.cost < before.best.fit.cost - 10.0
    level = after.best.fit.parameterization.values(after.best.fit.x)[0]
    assert level == pytest.approx(LEVEL, rel=0.02)


def test_what_has_no_dry_friction_goes_on_as_it_was(early):
    before, after = early
    without = [c for c in before.candidates if "coulomb_friction" not in c.names]
    assert without
    names = {c.names: c.fit.cost for c in after.candidates}
    for one in without:
        assert names[one.names] <= one.fit.cost  # if it leads, it is fitted once more


def test_every_rig_that_is_fitted_has_it(early):
    _, after = early
    angle = after.problem.log.presliding_deg
    for problem in (after.problem, after.coarse):
        names = ("coulomb_friction", "stiction", "drive_friction", "tip_drag")
        for own in (problem.parameterization([name]) for name in names):
            assert own.rig(own.joined({})).presliding_deg == angle
    assert {c.names for c in after.singles} == {c.names for c in early[0].singles}


def test_other_forms_of_the_law_are_compared_at_that_angle(early):
    """At the usual one, friction that changes along the shaft would take up what the angle leaves."""
    _, after = early
    rig = RigParameters(kinetic_n_mm_per_mm=LEVEL, presliding_deg=0.3)
    nominal = replay_nominal(log_with_presliding(rig))
    begun = nominal.begun_as(after.problem, after.nominal)
    assert begun.problem.base.presliding_deg == after.problem.log.presliding_deg
    assert other_form(begun, after.best.fit, Workers()) is None


def test_a_stop_on_the_way_leaves_the_state_as_it_was(early, monkeypatch):
    before, _ = early
    stopped = Failure(effects=("coulomb_friction",), reason="stopped early: not tried", stopped=True)
    entry = RecordEntry(
        stage=STAGE, effects=stopped.effects, decision=Decision.STOPPED, reason=stopped.reason
    )
    monkeypatch.setattr(presliding, "leading_fitted_again", lambda *_: ([], (entry,)))
    after = presliding_of_dry_friction(before, Workers())
    assert after.candidates == before.candidates
    assert after.problem is before.problem
    assert after.record[-1] == entry


def test_a_best_that_fails_with_it_stays_as_it_was(early, monkeypatch):
    before, _ = early
    monkeypatch.setattr(presliding, "leading_fitted_again", lambda *_: ([], ()))
    after = presliding_of_dry_friction(before, Workers())
    assert after.candidates == before.candidates
    assert after.record[-1].decision is Decision.DROPPED


def test_the_same_set_does_not_ask_again(early):
    _, after = early
    assert presliding_of_dry_friction(after, Workers()) is after


@pytest.fixture(scope="module")
def misled(early):
    """As `early` after the stage, with an angle that an effect which was missing then had led to."""
    _, after = early
    wrong = [replace(p, log=replace(p.log, presliding_deg=0.5)) for p in (after.problem, after.coarse)]
    best = fit_all("other", [(wrong[0], ("coulomb_friction",))], Workers())[0]
    return replace(after, problem=wrong[0], coarse=wrong[1], candidates=tuple(best))


def test_a_better_set_gets_an_angle_of_its_own(misled):
    found = presliding_of_dry_friction(misled, Workers())
    assert found.problem.log.presliding_deg == pytest.approx(0.3, rel=0.1)
    assert found.best.fit.cost < misled.best.fit.cost - 10.0


def test_it_goes_back_to_the_usual_angle_if_that_leaves_little_more():
    usual, _ = searched(kinetic_n_mm_per_mm=LEVEL)
    wrong = replace(usual.problem, log=replace(usual.problem.log, presliding_deg=0.3))
    best, _ = fit_all("other", [(wrong, ("coulomb_friction",))], Workers())
    misled = replace(usual, problem=wrong, candidates=tuple(best))
    found = presliding_of_dry_friction(misled, Workers())
    assert found.problem.log.presliding_deg == PRESLIDING_DEG
    assert not told(found)


@pytest.mark.parametrize(
    "changes",
    [
        {"kinetic_n_mm_per_mm": LEVEL},  # the usual angle
        {"kinetic_n_mm_per_mm": 2e-4, "presliding_deg": 0.12},  # friction too weak for it to show
        {"tip_drag_n_mm_s_per_rad": 0.3},  # no dry friction
    ],
)
def test_where_nothing_asks_for_it_nothing_changes(changes):
    before, after = searched(**changes)
    assert after is before


def test_far_above_the_noise_it_is_not_asked_for(early):
    before, _ = early
    worse = replace(before.best, fit=replace(before.best.fit, cost=4.0 * before.best.fit.samples))
    far = replace(before, candidates=(worse,))
    assert presliding_of_dry_friction(far, Workers()) is far


def test_a_replay_without_dry_friction_is_the_same_at_any_angle():
    usual, other = (log_of(RigParameters(presliding_deg=a), seed=1, seconds=4.0) for a in (0.1, 0.4))
    for one, two in zip(usual.trials, other.trials, strict=True):
        np.testing.assert_array_equal(one["base_torque_n_mm"], two["base_torque_n_mm"])
