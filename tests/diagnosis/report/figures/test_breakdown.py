"""The residual by part, as bars."""

from diagnosis.in_sigma import over_sigma
from diagnosis.report.figures.breakdown import describe_breakdown, draw_breakdown


def test_the_breakdown_shows_nominal_and_explained_of_every_part(dry):
    figure = draw_breakdown(dry.found)
    signals = figure.axes[0]
    before, after = dry.found.assessment.breakdown, dry.found.assessment.breakdown_after
    widths = [bar.get_width() for bar in signals.patches]
    assert widths == [*before.signal.values(), *after.signal.values()]
    assert len(figure.axes) == 4


def test_nominal_bars_are_hatched_so_that_they_differ_without_colour(dry):
    bars = draw_breakdown(dry.found).axes[0].patches
    half = len(bars) // 2
    assert all(bar.get_hatch() for bar in bars[:half])
    assert not any(bar.get_hatch() for bar in bars[half:])


def test_the_legend_names_the_bars_not_the_line_of_the_floor(dry):
    legend = draw_breakdown(dry.found).axes[0].get_legend()
    named = dict(zip((t.get_text() for t in legend.get_texts()), legend.get_patches(), strict=True))
    assert list(named) == ["nominal", "explained"]
    assert named["nominal"].get_hatch()
    assert not named["explained"].get_hatch()


def test_words_have_the_numbers_of_the_bars(dry):
    told = dry.found.assessment
    said = describe_breakdown(dry.found)
    before, after = told.breakdown.signal["tip_angle_deg"], told.breakdown_after.signal["tip_angle_deg"]
    assert f"tip_angle_deg {over_sigma(before)} and {over_sigma(after)}" in said
