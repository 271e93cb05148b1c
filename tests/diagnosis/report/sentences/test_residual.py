"""What is left of a log, and where."""

from dataclasses import replace
from types import SimpleNamespace

import pytest
from diagnosis_fixtures import concluding

from diagnosis.assessment.advice.advice import advise
from diagnosis.in_sigma import in_sigma
from diagnosis.prepare.prepare import prepare
from diagnosis.report.sentences.residual import (
    in_one_trial,
    largest_parts,
    largest_residual,
    leading,
    reduction,
    replay_quality,
    with_one_more,
)
from diagnosis.residuals.lead import Lead
from diagnosis.selection.verdicts.verdict import VerdictKind


def test_a_numerical_error_that_was_not_looked_at_is_told_as_that(dry):
    told = replace(dry.found.assessment, numerical_error={})
    lines = replay_quality(replace(dry.found, assessment=told))
    assert [line.endswith("numerical error: not computed") for line in lines] == [True, True, False]


def test_one_trial_is_not_called_held_out(dry):
    alone = replace(dry.found, log=replace(dry.found.log, trials=dry.found.log.trials[:1]))
    assert "On trials that the fit has not seen, the residual" in reduction(dry.found)
    assert "not seen" not in reduction(alone)
    assert "which is also the one that was fitted" in reduction(alone)


def test_the_reduction_is_told_with_its_interval(dry):
    gap = dry.found.assessment.gap
    said = reduction(dry.found)
    assert f"from {in_sigma(gap.before)} to {in_sigma(gap.after)}" in said
    assert f"{100 * gap.shrink_low:.1f} to {100 * gap.shrink_high:.1f} %" in said


def test_what_stays_as_it_is_does_not_fall(dry):
    told = dry.found.assessment
    gap = replace(told.gap, before=1.0, after=0.9996, shrink=0.0004, shrink_low=0.0, shrink_high=0.001)
    same = replace(told, gap=gap, breakdown_after=told.breakdown)
    found = replace(dry.found, assessment=same)
    assert "the residual is 1.00 σ. 1 σ is the noise floor." in reduction(found)
    assert largest_parts(found) == f"Residual of the nominal model: {told.breakdown.largest}"


def test_one_more_effect_that_changes_nothing_is_said_to(dry):
    found = dry.found
    assert "Adding another effect changes almost nothing" in with_one_more(found)
    here = found.assessment.fitted_gap
    told = replace(found.assessment, with_one_more={"tip_drag": 0.5 * here})
    assert "would lower the residual" in with_one_more(replace(found, assessment=told))
    far = replace(told, fitted_gap=20.0 * here, with_one_more={"tip_drag": 19.95 * here})
    assert "changes almost nothing" in with_one_more(replace(found, assessment=far))
    nothing = replace(found.assessment, with_one_more={})
    assert with_one_more(replace(found, assessment=nothing)) == ""


def test_noise_and_numerical_error_are_told_by_sensor(dry):
    lines = replay_quality(dry.found)
    assert [line.split(":")[0] for line in lines] == [
        "base_torque_n_mm",
        "tip_angle_deg",
        "base_angle_deg",
    ]
    assert "numerical error: 0.0" in lines[0]


def test_the_largest_residual_is_told_with_where_it_is(dry):
    stretch, value = dry.found.assessment.breakdown.worst
    where = "Largest residual of the nominal model in 5 s, all sensors together"
    assert largest_residual(dry.found) == f"{where}: {in_sigma(value)}, {stretch}"


def test_table_sentence_and_advice_name_the_same_parts_with_the_same_numbers(dry):
    """What is said of an unknown effect, of the largest numbers of the tables before and after."""
    told = dry.found.assessment
    unknown = concluding(dry.found, kind=VerdictKind.UNKNOWN).verdict
    problem = SimpleNamespace(log=prepare(dry.found.log)[0])
    advice = advise(problem, unknown, told.breakdown, told.breakdown_after, {})
    for parts in (told.breakdown, told.breakdown_after):
        signal = max(parts.signal, key=parts.signal.get)
        phase = max(parts.phase, key=parts.phase.get)
        assert f"largest in {signal} ({in_sigma(parts.signal[signal])}) and" in parts.largest
        assert parts.largest.endswith(f"({in_sigma(parts.phase[phase])})")
        assert parts.largest in advice
        assert parts.largest in largest_parts(dry.found)


LEAD = Lead(signal="tip_angle_deg", by_s=0.1, low_s=0.05, high_s=0.2, correlation=-0.9, chance_limit=0.2)


@pytest.mark.parametrize(
    ("lead", "said"),
    [
        (LEAD, "The residual of tip_angle_deg leads that of base_torque_n_mm by 100 ms (95 % interval"),
        (
            replace(LEAD, signal="", low_s=-0.05),
            "not clear which residual leads: the 95 % interval of the time between them is -50 to",
        ),
        (replace(LEAD, signal="", correlation=0.1), "correlation of 0.10 is within chance (0.20)"),
        (None, "needs both sensors"),
    ],
)
def test_which_signal_leads_is_said_or_why_it_cannot_be(dry, lead, said):
    shape = replace(dry.found.assessment.shape, leads=lead)
    sentence = leading(replace(dry.found, assessment=replace(dry.found.assessment, shape=shape)))
    assert said in sentence
    assert ("not clear" in sentence) == (lead is None or not lead.signal)


@pytest.mark.parametrize(
    ("gaps", "told"),
    [
        ((3.9, 1.0, 1.02), True),
        ((3.9, 1.0, 1.2), False),
        ((1.2, 1.0, 1.0), False),
        ((3.9, 2.0, 1.0), False),
        ((3.9,), False),
    ],
)
def test_a_gap_that_lies_in_one_of_several_trials_is_told_as_such(dry, gaps, told):
    """Each trial has a stretch at the noise as well, but for the one that is off."""
    stretches = [(f"trial_{i + 1:02d}.csv", 0.0, 5.0, gap) for i, gap in enumerate(gaps)]
    where = replace(dry.found.assessment.breakdown, time_s=stretches)
    found = replace(dry.found, assessment=replace(dry.found.assessment, breakdown=where))
    said = in_one_trial(found)
    assert bool(said) is told
    assert not told or said.startswith(
        "All of the gap lies in trial_01.csv (3.90 σ; others are at the noise)"
    )
