"""Parameters of the best explanation."""

from dataclasses import replace

import pytest
from matplotlib.figure import Figure

from diagnosis.assessment.uncertainty.values_by_part import ValuesByPart
from diagnosis.report.sections import parameters
from diagnosis.report.sections.parameters import parameters_section
from diagnosis.selection.verdicts.verdict import VerdictKind


@pytest.fixture(autouse=True)
def _undrawn(monkeypatch):
    monkeypatch.setattr(parameters, "draw_joint", lambda _: Figure())


def test_values_stand_above_their_joint_uncertainty(dry):
    title, values, joint, _, picture = parameters_section(dry.found, dry.report)
    assert "Parameters" in title
    assert "coulomb_friction" in values
    assert "Joint uncertainty" in joint
    assert "coulomb_friction.level and stiffness_error.scale" in picture


def test_of_an_unknown_log_it_is_what_comes_nearest(dry):
    unknown = replace(
        dry.found, verdict=replace(dry.found.verdict, kind=VerdictKind.UNKNOWN, effects=())
    )
    said = "".join(parameters_section(unknown, {**dry.report, "parameters": {}}))
    assert "<h2" in said
    assert "What comes nearest" in said
    assert "This is not an explanation" in said
    assert "coulomb_friction" in said


def test_where_nothing_was_fitted_there_is_no_section(dry):
    nothing = replace(dry.found, verdict=replace(dry.found.verdict, kind=VerdictKind.NONE, effects=()))
    assert parameters_section(nothing, {**dry.report, "parameters": {}}) == []


def test_where_nothing_came_nearer_there_are_no_intervals_to_speak_of(dry):
    near = replace(dry.found.assessment.nearest, effects=())
    unknown = replace(
        dry.found,
        verdict=replace(dry.found.verdict, kind=VerdictKind.UNKNOWN, effects=()),
        assessment=replace(dry.found.assessment, nearest=near),
    )
    said = "".join(parameters_section(unknown, {**dry.report, "nearest": {"parameters": {}}}))
    assert "nothing that was tried improves on the nominal model" in said
    assert "intervals" not in said


def test_values_by_part_stand_below_what_comes_nearest(dry):
    own = ValuesByPart(
        effect="torque_bias",
        parameter="bias",
        unit="N mm",
        parts=("trial_01.csv", "trial_02.csv"),
        values=(0.25, -0.5),
        gap_common=3.0,
        gap_own=1.5,
    )
    turning = replace(own, parts=("turning forwards", "at rest"), gap_own=2.0)
    alike = replace(own, effect="damping_error", gap_own=2.99)
    near = replace(dry.found.assessment.nearest, by_trial=(own, alike), by_motion=(turning, alike))
    unknown = replace(
        dry.found,
        verdict=replace(
            dry.found.verdict, kind=VerdictKind.UNKNOWN, effects=(), as_near=(("tip_drag",),)
        ),
        assessment=replace(dry.found.assessment, nearest=near),
    )
    said = "".join(parameters_section(unknown, dry.report))
    assert "on the decimated log: tip_drag." in said
    assert "Trial by trial" in said
    assert "with common values it is 3.00 σ" in said
    assert "With one value for each (0.25 and -0.5 N mm)" in said
    assert "trial_02.csv" in said
    assert "By the motion of the base" in said
    assert "The motions of the base seem to differ in " in said
    assert "damping_error" not in said.split("Trial by trial")[1]  # neither named, nor does it differ
    alone = "".join(parameters_section(dry.found, dry.report))
    assert "Trial by trial" not in alone
