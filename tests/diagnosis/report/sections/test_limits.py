"""Detection limits."""

from dataclasses import replace

from matplotlib.figure import Figure

from diagnosis.report.sections import limits
from diagnosis.report.sections.limits import limits_section


def test_limits_stand_in_a_picture_and_a_table(dry, monkeypatch):
    monkeypatch.setattr(limits, "draw_limits", lambda _: Figure())
    _, _, picture, table = limits_section(dry.found)
    assert "chuck_backlash" in picture
    assert "chuck_backlash" in table


def test_without_limits_there_is_no_section(dry):
    told = replace(dry.found.assessment, detection_limits={})
    assert limits_section(replace(dry.found, assessment=told)) == []
