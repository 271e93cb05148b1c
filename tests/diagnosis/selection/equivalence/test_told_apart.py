"""One cause is named, and what it cannot be told from beside it."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import joined, log_of, start_of_search

from diagnosis.fitting.fit import fit_effects
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.selection.candidate import candidate
from diagnosis.selection.equivalence import told_apart as module
from diagnosis.selection.equivalence.equivalent_sets import Equivalent
from diagnosis.selection.equivalence.told_apart import told_apart
from diagnosis.selection.verdicts.verdict import VerdictKind
from diagnosis.stopping import StopReason, StopSignal
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed

EFFECTS = ("damping_error", "stiffness_error", "torque_scale", "coulomb_friction")
WORKERS = Workers()
ALIKE = frozenset(("damping_error", "stiffness_error"))


LAGS = ("torque_sensor_delay", "torque_low_pass")


def verdict_of(rig, *names, workers=WORKERS, effects=EFFECTS, **values):
    """The verdict on a log of a rig, where a search has tried one set of effects alone."""
    log = joined(log_of(rig, seconds=6.0), log_of(rig, seed=1, speed=-1.0, seconds=6.0))
    state = start_of_search(log, effects)
    parts = {name: np.log([value]) for name, value in values.items()}
    start = state.problem.parameterization(names).joined(parts)
    found = replace(state, candidates=(candidate(fit_effects(state.problem, names, start)),))
    return told_apart(found, workers).verdict


@pytest.fixture(scope="module")
def gain():
    return RigParameters(torque_scale=1.1)


def test_one_cause_that_nobody_tried_is_named_instead_of_two_that_are_alike(gain):
    found = verdict_of(gain, *sorted(ALIKE), damping_error=1.1, stiffness_error=1.1)
    assert (found.kind, found.effects) == (VerdictKind.EXPLAINED, ("torque_scale",))
    assert [frozenset(names) for names in found.confusable] == [{"torque_scale"}, ALIKE]


def test_one_cause_is_named_with_the_two_beside_it(gain):
    found = verdict_of(gain, "torque_scale", torque_scale=1.1)
    assert (found.kind, found.effects) == (VerdictKind.EXPLAINED, ("torque_scale",))
    assert [frozenset(names) for names in found.confusable] == [{"torque_scale"}, ALIKE]


def test_one_cause_is_named_beside_a_stiffness_that_is_within_its_scatter():
    """1 % of stiffness is no error: the gain alone explains what two effects that differ by it do."""
    rig = RigParameters(torque_scale=1.1, stiffness_scale=1.01)
    found = verdict_of(rig, *sorted(ALIKE), damping_error=1.1, stiffness_error=1.111)
    assert (found.kind, found.effects) == (VerdictKind.EXPLAINED, ("torque_scale",))


def test_sets_are_left_to_the_scatter_of_stiffness_and_damping_once_each():
    parts = {name: np.ones(1) for name in EFFECTS}
    sets = [
        ("torque_scale", "stiffness_error"),
        ("damping_error", "torque_scale"),
        ("damping_error", "stiffness_error"),
        ("coulomb_friction", "torque_scale"),
    ]
    equal = [Equivalent(names=names, parts={n: parts[n] for n in names}, cost=0.0) for names in sets]
    (left,) = module._without_scatter(equal)
    assert left.names == ("torque_scale",)
    assert list(left.parts) == ["torque_scale"]


def test_after_a_stop_what_was_left_out_is_noted(gain):
    stop = StopSignal()
    stop.request(StopReason.INTERRUPTED)
    workers = Workers(stop=stop)
    found = verdict_of(gain, "torque_scale", workers=workers, torque_scale=1.1)
    assert (found.effects, found.confusable) == (("torque_scale",), ())
    assert stop.left_out == ["what cannot be told apart"]


def test_two_that_are_off_differently_are_undecided_between_all_pairs():
    rig = RigParameters(stiffness_scale=1.2, damping_scale=0.85)
    found = verdict_of(rig, *sorted(ALIKE), stiffness_error=1.2, damping_error=0.85)
    assert found.kind is VerdictKind.UNDECIDED
    told = {frozenset(names) for names in found.confusable}
    assert {ALIKE, frozenset(("torque_scale", "damping_error"))} <= told
    assert frozenset(("torque_scale", "stiffness_error")) in told


def test_an_imperfection_of_a_sensor_that_nobody_tried_takes_the_place_of_an_effect():
    """A low-pass filter of 5 ms is nearly a delay, and nothing that a verdict names."""
    rig = RigParameters(torque_low_pass_s=0.005)
    found = verdict_of(rig, "torque_sensor_delay", effects=LAGS, torque_sensor_delay=0.005)
    assert found.kind is VerdictKind.NONE or () in found.confusable
    assert not any("torque_low_pass" in names for names in found.confusable)


def test_a_delay_of_the_torque_is_named_beside_filters():
    """Negative control: 60 ms of delay and of a filter differ where the base turns on and off."""
    found = verdict_of(
        RigParameters(torque_delay_s=0.06), LAGS[0], effects=LAGS, torque_sensor_delay=0.06
    )
    assert (found.kind, found.effects) == (VerdictKind.EXPLAINED, ("torque_sensor_delay",))


def test_an_effect_of_its_own_kind_is_named_alone():
    """Negative control."""
    rig = RigParameters(kinetic_n_mm_per_mm=0.001)
    found = verdict_of(rig, "coulomb_friction", coulomb_friction=0.001)
    assert (found.kind, found.confusable) == (VerdictKind.EXPLAINED, ())


def test_what_takes_the_lead_is_told_from_its_own_equivalents(gain, monkeypatch):
    """An equivalent of the two that the search has found leads, and has one that the two do not have."""

    def equals(_, best, *__):
        known = {frozenset(("torque_scale",)): "coulomb_friction", ALIKE: "torque_scale"}
        own = known[frozenset(best.named)]
        return (Equivalent(names=(own,), parts={own: np.log([1.1])}, cost=0.0),)

    monkeypatch.setattr(module, "equivalent_sets", equals)
    found = verdict_of(gain, *sorted(ALIKE), damping_error=1.1, stiffness_error=1.1)
    assert found.effects == ("torque_scale",)
    assert ("coulomb_friction",) in found.confusable


@pytest.mark.parametrize(
    ("alike", "begins"), [(1.5, "best"), (2.0, "alike")], ids=["as the best has it", "as is alike"]
)
def test_an_equivalent_set_begins_where_less_is_left(alike, begins, monkeypatch):
    """Whatever is open besides is that of the best."""
    rig = RigParameters(tip_bias_deg=2.0, kinetic_n_mm_per_mm=0.001, damping_scale=1.02)
    problem = start_of_search(log_of(rig, seconds=4.0), effects=()).problem
    names = ("tip_angle_bias", "speed_dependent_friction")
    best = candidate(fit_effects(problem, names))
    at_bias = best.fit.parts["tip_angle_bias"]
    shared = at_bias if begins == "alike" else at_bias * alike / 2.0
    parts = {"tip_angle_bias": shared, "coulomb_friction": best.fit.parts[names[1]]}
    known = best if begins == "best" else replace(best, fit=_with_bias(best.fit, 0.5 * at_bias))
    swapped = ("tip_angle_bias", "coulomb_friction")
    begun = []
    monkeypatch.setattr(module, "fit_in_turn", lambda problem, names, x: begun.append(x))
    module._fit(problem, swapped, parts, known.fit.parts)
    found = problem.parameterization(swapped).parts(begun[0])
    assert found["tip_angle_bias"] == pytest.approx(at_bias)
    assert found["damping_error"] == pytest.approx(best.fit.parts["damping_error"])


def test_a_start_that_cannot_be_simulated_is_not_taken(monkeypatch):
    """Nor does it end the diagnosis."""
    problem = start_of_search(log_of(RigParameters(), seconds=2.0), effects=()).problem
    names, begun = ("tip_angle_bias",), []
    own = problem.parameterization(names)
    bad, good = ({"tip_angle_bias": np.array([bias])} for bias in (0.1, 3.0))

    def residuals(_, rigs, **__):
        if rigs[0] == own.rig(own.joined(bad)):
            raise SimulationFailed("no step converges")
        return [[np.ones(3)]]

    monkeypatch.setattr(type(problem), "residuals", residuals)
    monkeypatch.setattr(module, "fit_in_turn", lambda problem, names, x: begun.append(x))
    for alike, best in ((bad, good), (good, bad)):
        module._fit(problem, names, alike, best)
    assert [own.parts(x)["tip_angle_bias"] for x in begun] == [good["tip_angle_bias"]] * 2


def _with_bias(fit, bias):
    own = np.array([owner == "tip_angle_bias" for owner in fit.parameterization.owners])
    return replace(fit, x=np.where(own, bias, fit.x))
