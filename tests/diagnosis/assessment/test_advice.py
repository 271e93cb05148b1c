"""What to run next, in words."""

from dataclasses import replace
from types import SimpleNamespace

import pytest
from diagnosis_fixtures import RIG, prepared, scored, trial, turns

from diagnosis.assessment import advice
from diagnosis.assessment.advice import advise
from diagnosis.assessment.experiments import Experiment
from diagnosis.assessment.next_experiment import Proposal
from diagnosis.assessment.residual_breakdown import ResidualBreakdown
from diagnosis.prepare.prepared_log import PreparedLog
from diagnosis.selection.verdict import VerdictKind, verdict_on

LEFT = ResidualBreakdown(
    signal={"tip_angle_deg": 3.0, "base_torque_n_mm": 1.0},
    phase={"turning": 1.0, "holding": 2.0},
    band_hz=[],
    depth_mm=[],
    time_s=[],
)
READY = prepared(trial(turns(2.0)))
PROBLEM = SimpleNamespace(log=PreparedLog(rig=RIG, trials=(READY,)))
UNDECIDED = verdict_on([scored(["tip_drag"], 100.0), scored(["entry_friction"], 101.0)])


@pytest.mark.parametrize(
    ("separation", "said"),
    [
        (7.5, "turn slowly: there tip_drag and entry_friction would lie 7.5 standard deviations apart"),
        (1.0, "turn slowly, about 25 times: in each run tip_drag and entry_friction would lie 1.0"),
        (0.1, "no run that this rig can do would tell tip_drag from entry_friction: in the best, turn"),
    ],
)
def test_two_explanations_are_told_apart_by_as_many_runs_as_that_takes(monkeypatch, separation, said):
    run = Experiment(words="turn slowly", trial=READY)
    proposal = Proposal(experiment=run, separation=separation)
    monkeypatch.setattr(advice, "best_experiment", lambda *_: proposal)
    assert UNDECIDED.kind is VerdictKind.UNDECIDED
    assert advise(PROBLEM, UNDECIDED, LEFT).startswith(said)


@pytest.mark.parametrize(
    ("sliding", "said"),
    [
        (7.5, "no turn of the base alone would tell tip_drag from entry_friction; if the rig can slide"),
        (1.0, "no run that this rig can do would tell"),
    ],
)
def test_sliding_is_asked_of_a_rig_without_an_axis_only_where_no_turn_tells(monkeypatch, sliding, said):
    def best(problem, one, other, feasible):
        run = next(iter(feasible))
        return Proposal(experiment=run, separation=sliding if "sliding" in run.words else 0.1)

    monkeypatch.setattr(advice, "best_experiment", best)
    found = advise(PROBLEM, UNDECIDED, LEFT)
    assert found.startswith(said)
    assert "deep" not in found


def test_what_is_unknown_is_to_be_looked_at_where_it_is_largest():
    unknown = replace(UNDECIDED, kind=VerdictKind.UNKNOWN)
    slides = PreparedLog(rig=RIG, trials=(prepared(trial(turns(2.0), speed=-1.0)),))
    said = advise(SimpleNamespace(log=slides), unknown, LEFT)
    assert "largest in tip_angle_deg while holding" in said
    assert "at two depths and two rates" in said


def test_a_rig_without_depth_gets_no_advice_about_depths():
    said = advise(PROBLEM, replace(UNDECIDED, kind=VerdictKind.UNKNOWN), LEFT)
    assert "largest in tip_angle_deg while holding" in said
    assert "at two rates and two amplitudes, with reversals and with rests" in said
    assert "depth" not in said


def test_where_nothing_is_left_to_tell_apart_nothing_is_said():
    settled = verdict_on([scored(["tip_drag"], 100.0)])
    assert advise(PROBLEM, settled, LEFT) == ""
