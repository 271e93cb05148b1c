"""What is told of an unknown log beside the nearest explanation."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from diagnosis_fixtures import RIG, log_of
from free_forms import free_fit, nothing_told
from rig_outside import log_outside

from diagnosis.criteria.freeform import CLOSED_GAP
from diagnosis.effects.effect import Place
from diagnosis.fitting.decimation import decimated
from diagnosis.freeform import unknown
from diagnosis.freeform.missing.in_words import DOUBT, what_is_missing
from diagnosis.freeform.unknown import FREE_FORM, Told, with_what_is_missing
from diagnosis.nominal_replay import replay_nominal
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.candidate import candidate
from diagnosis.selection.verdicts.decision import verdict_on
from diagnosis.selection.verdicts.verdict import VerdictKind
from diagnosis.stopping import StopReason, StopSignal
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed

PROBLEM = SimpleNamespace(noise=SimpleNamespace(colour={}))  # white
TOLD = nothing_told(nearest=SimpleNamespace(gap_after=1.01, at_bound=()))


def missing_from(fits, monkeypatch, kind=VerdictKind.UNKNOWN, stop=None, near=TOLD):
    """What is told where the search for laws comes to these fits, and the signal."""
    stop = StopSignal() if stop is None else stop
    monkeypatch.setattr(unknown, "free_form_fits", fits)
    verdict, workers = SimpleNamespace(kind=kind, other_form=""), Workers(stop=stop)
    log = SimpleNamespace(trials=(None, None))
    known = Told(problem=PROBLEM, verdict=verdict, assessment=near)
    told = with_what_is_missing(log, known, None, (), (), workers)
    return told.missing, told.assessment, stop


@pytest.mark.parametrize("kind", [k for k in VerdictKind if k is not VerdictKind.UNKNOWN])
def test_of_a_log_that_is_not_unknown_nothing_is_looked_for(kind, monkeypatch):
    missing, told, _ = missing_from(pytest.fail, monkeypatch, kind)
    assert (missing, told) == (None, TOLD)


def test_a_law_that_does_not_help_leaves_the_assessment_as_it_is(monkeypatch):
    missing, told, _ = missing_from(lambda *_: (free_fit(1.0),), monkeypatch)
    assert missing.law is None
    assert told is TOLD


def test_a_law_that_helps_takes_the_place_of_the_nearest_explanation(monkeypatch):
    better = nothing_told(gap=SimpleNamespace(before=5.0, after=0.5))
    monkeypatch.setattr(unknown, "explained_by", lambda *_: better)
    missing, told, _ = missing_from(lambda *_: (free_fit(0.5, title="gap"),), monkeypatch)
    assert missing.law.title == "gap"
    assert told is better


@pytest.mark.parametrize(
    ("nearest_gap", "at_bound", "told_all_the_same"),
    [
        (1.01, (), False),
        (1.01, ("layered_tissue.ratio",), True),
        (1.2, ("layered_tissue.ratio",), False),
    ],
)
def test_what_is_refused_for_a_bound_leaves_little_and_explains_nothing(
    nearest_gap, at_bound, told_all_the_same, monkeypatch
):
    """A law has not to leave less than that; far above the noise it has."""
    better = nothing_told(gap=SimpleNamespace(before=5.0, after=1.0))
    monkeypatch.setattr(unknown, "explained_by", lambda *_: better)
    near = nothing_told(nearest=SimpleNamespace(gap_after=nearest_gap, at_bound=at_bound))
    gap = nearest_gap - 0.005
    missing, _, _ = missing_from(lambda *_: (free_fit(gap),), monkeypatch, near=near)
    assert (missing.law is not None) is told_all_the_same


@pytest.mark.parametrize(("gap", "told_all_the_same"), [(2.0, False), (1.05, True)])
def test_a_law_that_predicts_less_than_the_nominal_rig_is_told_only_where_it_closes_the_gap(
    gap, told_all_the_same, monkeypatch
):
    """Then the other trials leave it open, and what it predicts there is within that."""
    worse = nothing_told(gap=SimpleNamespace(before=5.0, after=5.5))
    monkeypatch.setattr(unknown, "explained_by", lambda *_: worse)
    near = nothing_told(nearest=SimpleNamespace(gap_after=4.0, at_bound=()))
    missing, told, _ = missing_from(lambda *_: (free_fit(gap),), monkeypatch, near=near)
    assert (missing.law is not None) is told_all_the_same
    assert told is (worse if told_all_the_same else near)


def test_after_a_stop_it_is_noted_as_left_out(monkeypatch):
    late, ended = StopSignal(), StopSignal()
    late.request(StopReason.INTERRUPTED)
    assert missing_from(pytest.fail, monkeypatch, stop=late)[:2] == (None, TOLD)

    def stopped_meanwhile(*_):
        ended.request(StopReason.INTERRUPTED)
        return ()

    assert missing_from(stopped_meanwhile, monkeypatch, stop=ended)[:2] == (None, TOLD)
    assert late.left_out == ended.left_out == [FREE_FORM]


def test_laws_that_were_fitted_before_a_stop_are_told(monkeypatch):
    stop = StopSignal()

    def stopped_meanwhile(*_):
        stop.request(StopReason.INTERRUPTED)
        return (free_fit(0.5, title="gap"),)

    better = nothing_told(gap=SimpleNamespace(before=5.0, after=0.5))
    monkeypatch.setattr(unknown, "explained_by", lambda *_: better)
    missing, told, _ = missing_from(stopped_meanwhile, monkeypatch, stop=stop)
    assert missing.law.title == "gap"
    assert told is better
    assert stop.left_out == [FREE_FORM]


def test_all_is_told_in_the_noise_that_a_law_leaves(monkeypatch):
    """Verdict, assessment and fits; what was taken for noise, a law explains."""
    nominal = replay_nominal(log_of(NOMINAL, seconds=6.0))
    loud = nominal.problem
    quiet = replace(loud.noise, sigma={s: 0.5 * size for s, size in loud.noise.sigma.items()})
    verdict = replace(verdict_on([candidate(nominal.fit)]), kind=VerdictKind.UNKNOWN)
    known = Told(problem=loud, verdict=verdict, assessment=TOLD)

    def assessed(_, problem, *__):
        return TOLD if problem.noise is quiet else None

    def explained(_, __, problem, *___):
        return replace(TOLD, gap=SimpleNamespace(before=2.0, after=problem.noise is quiet))

    monkeypatch.setattr(unknown, "free_form_fits", lambda *_: (free_fit(0.8),))
    monkeypatch.setattr(unknown, "noise_left", lambda *_: quiet)
    monkeypatch.setattr(unknown, "fits_in_noise", lambda *_: (free_fit(0.9),))
    monkeypatch.setattr(unknown, "assess", assessed)
    monkeypatch.setattr(unknown, "explained_by", explained)
    coarse = decimated(loud, nominal.predictions)
    told = with_what_is_missing(nominal.log, known, coarse, nominal.predictions, (), Workers())
    assert told.problem.noise is quiet
    assert told.missing.best.gap_after == 0.9
    assert told.assessment.gap.after is True
    # Residuals are twice as many of the halved noise.
    left = np.concatenate(told.verdict.best.fit.by_trial) / np.concatenate(nominal.fit.by_trial)
    np.testing.assert_allclose(left, 2.0)


@pytest.mark.parametrize("how", ["cannot be simulated", "stopped", "none of the log itself"])
def test_where_no_law_can_be_fitted_in_less_noise_those_that_were_are_told(how, monkeypatch):
    workers = Workers(stop=StopSignal())

    def failing(*_):
        if how == "cannot be simulated":
            raise SimulationFailed("the simulation lost its numbers")
        if how == "stopped":
            workers.stop.request(StopReason.INTERRUPTED)
        return (free_fit(0.9, final=how == "stopped"),)

    problem = SimpleNamespace(noise=None)
    monkeypatch.setattr(unknown, "noise_left", lambda *_: "less")
    monkeypatch.setattr(unknown, "in_noise", lambda *_: (None, None))
    monkeypatch.setattr(unknown, "fits_in_noise", failing)
    fits = (free_fit(0.8),)
    assert unknown._in_the_noise_left(problem, None, fits, (), workers) == (fits, None)


def test_laws_of_which_none_can_be_simulated_are_no_stop(monkeypatch):
    def failing(*_):
        raise SimulationFailed("the simulation lost its numbers")

    for fits in (failing, lambda *_: ()):
        missing, told, stop = missing_from(fits, monkeypatch)
        assert (missing, told, stop.left_out) == (None, TOLD, [])


def told_of(log, nearest_gap):
    """What is told of a log whose verdict is unknown, by all families and through the simulation."""
    nominal = replay_nominal(log)
    coarse = decimated(nominal.problem, nominal.predictions)
    verdict = SimpleNamespace(kind=VerdictKind.UNKNOWN, other_form="")
    told = nothing_told(nearest=SimpleNamespace(gap_after=nearest_gap, at_bound=()))
    known = Told(problem=nominal.problem, verdict=verdict, assessment=told)
    found = with_what_is_missing(nominal.log, known, coarse, nominal.predictions, (), Workers())
    return found.missing, found.assessment


@pytest.mark.slow
def test_friction_that_is_stronger_one_way_is_found_without_a_name():
    """Of the independent rig: dry, of 0.002 (1 +- 0.6), beside the nominal damping."""
    log = log_outside({"one_way_friction": {"level": 0.002, "asymmetry": 0.6}})
    missing, told = told_of(log, 5.0)
    assert max(missing.place, key=missing.place.get) is Place.INTERFACE
    assert missing.place[Place.INTERFACE] > 0.8
    assert missing.depends_on[0].variable == "direction"
    assert missing.depends_on[1].gap_after > 2.0
    assert missing.closed
    slow = 0.03 * RIG.tissue.damping_n_mm_s_per_mm  # at the rate of which the law is told
    for truth, value, low, high in zip(
        (0.0008 + slow, 0.0032 + slow), missing.law.y, missing.law.low, missing.law.high, strict=True
    ):
        # Half the band is 1.96 standard deviations, of which the values are within 3.5.
        assert abs(value - truth) < 3.5 / 1.96 * 0.5 * (high - low)
    assert told.gap.before > 10.0
    assert told.gap.after < 1.1
    assert "acts between shaft and tissue" in what_is_missing(missing, told.gap.before)


@pytest.mark.slow
def test_cogging_of_the_drive_is_found_with_its_waves():
    ripple = {"amplitude": 0.06, "teeth": 16.0, "phase": 30.0}
    missing, told = told_of(log_outside({"torque_ripple": ripple}), 3.0)
    assert max(missing.place, key=missing.place.get) is Place.DRIVE
    assert missing.depends_on[0].variable == "base_angle"
    assert f"every {360 / 16:.3g} deg" in missing.best.family.name
    assert missing.law.shape == "sine wave"
    assert max(missing.law.y) - min(missing.law.y) == pytest.approx(2 * 0.06, rel=0.2)
    assert told.gap.after < CLOSED_GAP < told.gap.before


@pytest.mark.slow
def test_of_a_rig_with_nothing_missing_no_law_is_told():
    missing, told = told_of(log_outside({}), 1.0)
    assert missing.law is None
    assert told.gap is None  # the assessment is as it was
    assert DOUBT in what_is_missing(missing, 1.0)
