"""The summary on the screen: each thing is told, and once."""

import io
from dataclasses import replace

import pytest
from diagnosis_fixtures import concluding
from rich.console import Console

from diagnosis.selection.verdicts.verdict import VerdictKind
from scripts.diagnosis_summary import summary

DRIFT = "a drift of the torque sensor, by up to"


def printed(found):
    """The summary, without the breaks of its lines."""
    console = Console(file=io.StringIO(), width=400)
    summary(found, console)
    return console.file.getvalue()


def drifting(found):
    """The same, with a torque sensor that drifts."""
    sensors = replace(
        found.assessment.sensors, drift_sigma={"base_torque_n_mm": 5.0, "tip_angle_deg": 0.0}
    )
    return replace(found, assessment=replace(found.assessment, sensors=sensors))


def test_an_explanation_is_told_with_residual_parameters_and_ranking(dry):
    said = printed(dry.found)
    assert said.startswith("Dry (Coulomb) friction along the shaft explains the gap")
    for title in (
        "Residual / σ, fitted to all trials",
        "By frequency / that of white noise",
        "What explains it",
        "Probability of each explanation",
    ):
        assert said.count(title) == 1
    assert "Detection limits" not in said
    assert "not shown: Not testable: load_dependent_friction" in said


def test_an_unknown_log_is_told_with_what_comes_nearest_and_no_ranking(dry):
    said = printed(concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=()))
    assert "What comes nearest" in said
    assert "This is not an explanation" in said
    assert "Probability of each explanation" not in said


@pytest.mark.parametrize(
    "verdict", [{"kind": VerdictKind.NONE, "effects": ()}, {"kind": VerdictKind.EXPLAINED}]
)
def test_what_the_sensors_do_is_told_once(dry, verdict):
    """Where it is all of the gap, by the first sentence; else by one of its own."""
    assert printed(drifting(concluding(dry.found, **verdict))).count(DRIFT) == 1


def test_warnings_of_the_log_were_told_while_it_was_read(dry):
    """Those of the diagnosis are told here."""
    log = replace(dry.found.log, warnings=("of the log",))
    told = replace(dry.found.assessment, warnings=("of the diagnosis",))
    found = replace(dry.found, log=log, assessment=told)
    assert set(found.warnings) >= {"of the log", "of the diagnosis"}
    said = printed(found)
    assert "warning: of the diagnosis" in said
    assert "of the log" not in said
