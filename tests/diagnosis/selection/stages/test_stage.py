"""What stages share: time that runs out, screening with a record."""

from dataclasses import replace

import numpy as np
from diagnosis_fixtures import fit_of, scored

from diagnosis.criteria.selection import NEAR_FLOOR, SECOND_LEAVES, WORTH_THE_LOG
from diagnosis.effects import LIBRARY
from diagnosis.fitting.fit import fit_effects
from diagnosis.selection.record import Decision, RecordEntry
from diagnosis.selection.screening import Screened
from diagnosis.selection.stages import stage as module
from diagnosis.selection.stages.stage import (
    first_that_explains,
    not_worth,
    run_stages,
    screen_all,
    stopped_in,
)
from diagnosis.stopping import StopSignal
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed


def noting(state, _):
    return state.noting("ran")


def test_stages_run_while_there_is_time_and_are_told_of_when_there_is_not(still_start):
    state = replace(still_start, candidates=(scored(["tip_drag"], 1.0),))
    assert run_stages((noting, noting), state, Workers()).record == ("ran", "ran")
    stop = StopSignal(1e-9)
    assert run_stages((noting,), state, Workers(stop=stop)) is state
    assert stop.left_out == ["noting"]


def test_the_first_stage_runs_in_any_case(still_start):
    assert run_stages((noting,), still_start, Workers(stop=StopSignal(1e-9))).record == ("ran",)


def test_of_stages_the_first_that_explains_the_log_counts_and_the_others_are_not_asked(
    still_start, monkeypatch
):
    """Each begins where the state is, not where the one before has come to."""
    monkeypatch.setattr(type(still_start), "rechecked", lambda own: (own, "explains" in own.record))

    def useless(state, _):
        return state.noting("useless")

    def explaining(state, _):
        return state.noting("explains")

    found = first_that_explains((useless, explaining, useless), still_start, Workers())
    assert found.record == ("explains",)
    assert first_that_explains((useless,), still_start, Workers()) is None


def test_screening_keeps_all_starts_and_records_what_cannot_be_simulated(dry_start):
    lame = replace(LIBRARY["tip_drag"], apply=failing)
    coarse = replace(dry_start.coarse, library={**LIBRARY, "tip_drag": lame})
    base = fit_effects(coarse, ())
    calls = [(coarse, base, name) for name in ("coulomb_friction", "tip_drag")]
    found, record = screen_all("single effects", calls, Workers())
    assert {s.names for s in found} == {("coulomb_friction",)}
    assert [(e.effects, e.decision) for e in record] == [(("tip_drag",), Decision.FAILED)]
    told = not_worth("single effects", found, [])
    assert [e.effects for e in told] == [("coulomb_friction",)]
    assert not_worth("single effects", found, found) == ()


def test_what_a_stop_cut_short_is_found_in_the_record():
    cut = RecordEntry(stage="any", effects=(), decision=Decision.STOPPED, reason="no time")
    kept = replace(cut, decision=Decision.KEPT)
    assert stopped_in((kept, cut)) == [cut]


def test_what_promises_enough_on_the_decimated_log_has_to_on_the_log_itself(still_start, monkeypatch):
    one = replace(scored(["stiction"], 1.0), fit=fit_of(("stiction",), cost=1000.0))
    state = replace(still_start, candidates=(one,))
    promises, asked = {"tip_drag": 1.001, "torque_bias": 0.999}, (1 - SECOND_LEAVES) * 250.0

    def screen_all(_, calls, __):
        assert all(problem is state.problem for problem, *_ in calls)
        found = [adding(name, base.cost - promises[name] * asked, base.names) for _, base, name in calls]
        return found, ()

    monkeypatch.setattr(module, "screen_all", screen_all)
    coarse = [adding(name, 1.0, ("stiction",)) for name in promises]
    elsewhere = adding("tip_drag", 1.0, ("sheath_friction",))  # beside what was not fitted to the log
    found = module.promising_on_the_log("pairs", [*coarse, elsewhere], 250.0, state, Workers())
    assert found == [coarse[0], elsewhere]


def adding(name, cost, base):
    return Screened(names=(*base, name), start=np.zeros(2), cost=cost, gain=0.0)


def failing(*_, **__):
    """What cannot be simulated at all."""
    raise SimulationFailed("the simulation lost its numbers")


def leaving(name, cost, samples=100):
    """A candidate of the decimated log that leaves such a cost."""
    fit = fit_of((name,), by_trial=[np.zeros(samples)], cost=cost)
    return replace(scored([name], cost), fit=fit)


def test_what_leaves_hardly_less_than_the_best_before_does_not_go_to_the_log():
    best, behind = leaving("coulomb_friction", 300.0), leaving("tip_drag", 900.0)
    share = WORTH_THE_LOG * (300.0 - 100)
    enough, little = leaving("stiction", 300.0 - share), leaving("torque_bias", 301.0 - share)
    worth, record = module.worth_the_log("any", [enough, little], [behind, best])
    assert worth == [enough]
    assert [(e.effects, e.decision) for e in record] == [(("torque_bias",), Decision.DROPPED)]
    assert module.worth_the_log("any", [little], []) == ([little], ())


def test_what_leaves_far_more_than_the_best_is_built_on_by_nothing():
    near, far = (
        leaving("tip_drag", 0.99 * NEAR_FLOOR * 100),
        leaving("stiction", 1.01 * NEAR_FLOOR * 100),
    )
    best = leaving("torque_bias", 100.0)
    assert module.near_the_best([far, near], [best], 4) == [near]
    assert module.near_the_best([far, near], [], 4) == [near, far]
    assert module.near_the_best([far, near], [], 1) == [near]


def test_effects_behind_a_part_of_their_own_crowd_out_no_rival():
    """Two lags of the torque that are nearly alike, and one of them with what does nothing."""
    first, rival = scored(["torque_sensor_delay"], 1.0), scored(["torque_low_pass"], 5.0)
    idle = [scored(["torque_sensor_delay", name], 2.0) for name in ("tip_clock", "tip_drag")]
    better = scored(["torque_low_pass", "stiction"], 4.0)
    ranked = module.simplest_first([*idle, first, better, rival])
    assert ranked == [first, better, rival, *idle]


def test_the_nominal_rig_is_fitted_again_with_the_leading_explanations(still_start, monkeypatch):
    """Whatever leads before outliers are left out leads by these."""
    leading = ["stiction", "tip_drag", "torque_bias", "coulomb_friction", "chuck_backlash"]
    nominal = (scored([], 50.0), scored([], 40.0))
    others = tuple(scored([name], 10.0 + i) for i, name in enumerate(leading))
    seen = []

    def fit_all(_, calls, __):
        seen.extend(names for _, names, _ in calls)
        return [], ()

    monkeypatch.setattr(module, "fit_all", fit_all)
    state = replace(still_start, candidates=(*nominal, *others))
    module.leading_fitted_again("any", state, state.problem, Workers())
    assert sorted(seen) == sorted([(), *((name,) for name in leading[: module.FINALISTS])])


def test_what_comes_near_on_the_decimated_log_is_fitted_to_the_log_from_there(still_start, monkeypatch):
    """Not from where the search was, which knows nothing of what is open now."""
    near, far = scored(["tip_drag"], 1.0), scored(["torque_bias"], 2.0)
    rare = [
        replace(c, fit=replace(c.fit, x=2.0 * c.fit.x, by_trial=(np.full(10, left),)))
        for c, left in ((near, 1.0), (far, 9.0))
    ]
    asked = []

    def fit_all(_, calls, __):
        asked.append([(problem, names, tuple(start)) for problem, names, start in calls])
        return (rare if len(asked) == 1 else []), ()

    monkeypatch.setattr(module, "fit_all", fit_all)
    state = replace(still_start, candidates=(near, far))
    module.near_fitted_again("any", state, replace(still_start, candidates=()), Workers())
    start = still_start.problem.parameterization(["tip_drag"]).joined(rare[0].fit.parts)
    assert asked[1] == [(still_start.problem, ("tip_drag",), tuple(start))]
    assert np.array_equal(rare[0].fit.parts["tip_drag"], 2.0 * near.fit.parts["tip_drag"])
