"""What to run next, in words."""

from dataclasses import replace
from types import SimpleNamespace

import pytest
from diagnosis_fixtures import RIG, prepared, scored, trial, turns

from diagnosis.assessment.advice import advice
from diagnosis.assessment.advice.advice import advise
from diagnosis.assessment.advice.experiments import Experiment
from diagnosis.assessment.advice.next_experiment import Narrowing, Proposal
from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.criteria.assessment import KNOWN_WELL
from diagnosis.effects import LIBRARY
from diagnosis.prepare.prepared_log import PreparedLog
from diagnosis.residuals.residual_breakdown import ResidualBreakdown
from diagnosis.selection.verdicts.changed import with_open_effects
from diagnosis.selection.verdicts.decision import verdict_on
from diagnosis.selection.verdicts.verdict import VerdictKind

LEFT = ResidualBreakdown(
    signal={"tip_angle_deg": 3.0, "base_torque_n_mm": 1.0},
    phase={"turning": 1.0, "holding": 2.0},
    band_hz=[],
    depth_mm=[],
    time_s=[],
)
NOMINAL = replace(LEFT, signal={"tip_angle_deg": 3.0, "base_torque_n_mm": 5.0})
READY = prepared(trial(turns(2.0)))
PROBLEM = SimpleNamespace(log=PreparedLog(rig=RIG, trials=(READY,)))
UNDECIDED = verdict_on([scored(["tip_drag"], 100.0), scored(["entry_friction"], 101.0)])


@pytest.mark.parametrize(
    ("separation", "said"),
    [
        (7.5, "turn slowly: there tip_drag and entry_friction would lie 7.5 standard deviations apart"),
        (1.0, "turn slowly, about 25 times: in each run tip_drag and entry_friction would lie 1.0"),
        (0.1, f"{LIBRARY['tip_drag'].check}: no run that this rig can do would tell tip_drag from"),
    ],
)
def test_two_explanations_are_told_apart_by_as_many_runs_as_that_takes(monkeypatch, separation, said):
    run = Experiment(words="turn slowly", trial=READY)
    proposal = Proposal(experiment=run, separation=separation)
    monkeypatch.setattr(advice, "best_experiment", lambda *_: proposal)
    assert UNDECIDED.kind is VerdictKind.UNDECIDED
    assert advise(PROBLEM, UNDECIDED, NOMINAL, LEFT, {}).startswith(said)


@pytest.mark.parametrize(
    ("sliding", "said"),
    [
        (7.5, "no turn of the base alone would tell tip_drag from entry_friction; if the rig can slide"),
        (1.0, f"{LIBRARY['tip_drag'].check}: no run that this rig can do would tell"),
    ],
)
def test_sliding_is_asked_of_a_rig_without_an_axis_only_where_no_turn_tells(monkeypatch, sliding, said):
    def best(problem, one, other, feasible):
        run = next(iter(feasible))
        return Proposal(experiment=run, separation=sliding if "sliding" in run.words else 0.1)

    monkeypatch.setattr(advice, "best_experiment", best)
    found = advise(PROBLEM, UNDECIDED, NOMINAL, LEFT, {})
    assert found.startswith(said)
    assert "deep" not in found


def test_what_is_unknown_is_to_be_looked_at_where_it_is_largest():
    unknown = replace(UNDECIDED, kind=VerdictKind.UNKNOWN)
    slides = PreparedLog(rig=RIG, trials=(prepared(trial(turns(2.0), speed=-1.0)),))
    said = advise(SimpleNamespace(log=slides), unknown, NOMINAL, LEFT, {})
    assert f"of the nominal model is {NOMINAL.largest}" in said
    assert f"that of the nearest explanation is {LEFT.largest}: repeat" in said
    assert "repeat the phase in which the latter is largest alone, " in said
    assert "at two depths and two rates" in said


def test_a_rig_without_depth_gets_no_advice_about_depths():
    said = advise(PROBLEM, replace(UNDECIDED, kind=VerdictKind.UNKNOWN), NOMINAL, LEFT, {})
    assert "at two rates and two amplitudes, with reversals and with rests" in said
    assert "depth" not in said


def test_where_no_run_tells_the_measurement_that_does_by_itself_is_named(monkeypatch):
    proposal = Proposal(experiment=Experiment(words="turn slowly", trial=READY), separation=0.1)
    monkeypatch.setattr(advice, "best_experiment", lambda *_: proposal)
    said = advise(PROBLEM, UNDECIDED, NOMINAL, LEFT, {})
    assert said == (
        f"{LIBRARY['tip_drag'].check}: no run that this rig can do would tell tip_drag from "
        "entry_friction (in the best, turn slowly, they would lie 0.10 standard deviations apart)"
    )


DRAG = {"tip_drag": {"damping": Interval(value=0.2, low=0.1, high=0.3, unit="N mm s / rad")}}
SETTLED = verdict_on([scored(["tip_drag"], 100.0)])
CHANGE = "add viscous drag of 0.2 N mm s / rad at the tip to the model"


@pytest.mark.parametrize(
    ("factor", "said"),
    [
        (
            0.5,
            "to know the damping of viscous drag at the tip better, turn slowly: that would narrow its "
            "interval to about 50 %",
        ),
        (
            0.95,
            "no single run that this rig can do would narrow the interval of the damping of viscous",
        ),
    ],
)
def test_an_explanation_is_told_with_what_to_change_and_what_would_narrow_it(monkeypatch, factor, said):
    run = Narrowing(experiment=Experiment(words="turn slowly", trial=READY), factor=factor)
    monkeypatch.setattr(advice, "narrowest", lambda *_: run)
    found = advise(PROBLEM, SETTLED, NOMINAL, LEFT, DRAG)
    assert found.startswith(f"{CHANGE}; then record and diagnose again; {said}")


def test_what_is_known_well_needs_no_further_run(monkeypatch):
    monkeypatch.setattr(advice, "narrowest", pytest.fail)
    low, high = (0.2 + sign * 0.49 * KNOWN_WELL * 0.2 for sign in (-1, 1))
    known = {"tip_drag": {"damping": replace(DRAG["tip_drag"]["damping"], low=low, high=high)}}
    assert advise(PROBLEM, SETTLED, NOMINAL, LEFT, known) == f"{CHANGE}; then record and diagnose again"


def test_without_time_what_to_change_is_told_alone(monkeypatch):
    monkeypatch.setattr(advice, "narrowest", pytest.fail)
    monkeypatch.setattr(advice, "stopping", lambda: True)
    assert advise(PROBLEM, SETTLED, NOMINAL, LEFT, DRAG).endswith("diagnose again")


def test_what_has_a_rival_that_looks_the_same_is_to_be_calibrated(monkeypatch):
    monkeypatch.setattr(advice, "narrowest", pytest.fail)
    alike = (("torque_scale",), ("damping_error", "stiffness_error"))
    gain = replace(SETTLED, effects=("torque_scale",), confusable=alike)
    values = {"torque_scale": {"scale": Interval(value=1.1, low=1.0, high=1.2, unit="-")}}
    assert advise(PROBLEM, gain, NOMINAL, LEFT, values) == (
        "calibrate the torque sensor with a known weight on a lever: that distinguishes a wrong gain of "
        "the torque sensor from a wrong damping of the tissue and a wrong torsional stiffness "
        "at once; "
        "if it is the former, calibrate the torque sensor: divide its readings by 1.1"
    )


def test_where_nothing_is_left_to_do_nothing_is_said():
    nothing = replace(SETTLED, kind=VerdictKind.NONE, effects=())
    assert advise(PROBLEM, nothing, NOMINAL, LEFT, {}) == ""


def test_each_set_that_looks_the_same_has_the_check_that_tells_it():
    """A known weight at rest shows a gain, and no delay."""
    alike = (("torque_scale",), ("torque_sensor_delay", "torque_scale"), ("stiffness_error",))
    gain = replace(SETTLED, effects=("torque_scale",), confusable=alike)
    values = {"torque_scale": {"scale": Interval(value=1.1, low=1.0, high=1.2, unit="-")}}
    said = advise(PROBLEM, gain, NOMINAL, LEFT, values)
    late, known = LIBRARY["torque_sensor_delay"], LIBRARY["torque_scale"]
    first = (
        f"{late.check}: that distinguishes {known.title} from {late.title} and {known.title} at once; "
    )
    assert said.startswith(f"{first}{known.check}: that distinguishes {known.title} from ")


def test_what_may_hide_an_effect_asks_for_the_check_that_shows_it():
    found = with_open_effects(verdict_on([scored(["tip_drag"], 100.0)]), ["torque_bias"])
    said = advise(PROBLEM, found, NOMINAL, LEFT, {})
    assert "read the torque sensor without a needle" in said
    assert said.endswith("and an offset of the torque sensor at once")
