"""Why to believe the answer."""

from dataclasses import replace

import pytest
from matplotlib.figure import Figure

from diagnosis.report.sections import agreement
from diagnosis.report.sections.agreement import agreement_parts
from diagnosis.report.sentences.residual import reduction
from diagnosis.selection.verdicts.verdict import VerdictKind


def section_of(found):
    return [part for make, *shown in agreement_parts(found) for part in make(*shown)]


@pytest.fixture(autouse=True)
def _undrawn(monkeypatch):
    for name in ("draw_trial", "draw_loops", "draw_twist"):
        monkeypatch.setattr(agreement, name, lambda *_: Figure())


def test_every_trial_has_a_picture_of_its_own_then_loops_and_twist(dry):
    parts = section_of(dry.found)
    assert f"<p>{reduction(dry.found)}</p>" in parts
    pictures = [part for part in parts if part.startswith("<figure")]
    assert len(pictures) == len(dry.log.trials) + 2
    for picture, trial in zip(pictures, dry.log.trials, strict=False):
        assert f'alt="{trial.name} over' in picture


def test_without_time_for_the_twist_it_is_left_out(dry):
    told = replace(dry.found.assessment, twist=None)
    parts = section_of(replace(dry.found, assessment=told))
    assert not any("Twist along the shaft" in part for part in parts)


def test_the_nearest_to_an_unknown_log_is_not_to_be_believed(dry):
    unknown = replace(dry.found, verdict=replace(dry.found.verdict, kind=VerdictKind.UNKNOWN))
    said = "".join(section_of(unknown))
    assert "How near it comes" in said
    assert "Solid red: what comes nearest" in said
    assert "Why to believe it" not in said
    assert "explained" not in said
