"""The pictures of the page."""

import pytest

from models import published
from studies.published.report.pictures import draw_fits, draw_quick_turns, draw_residuals


def test_residuals_are_drawn_for_every_figure_and_leading_fit(study):
    (axis,) = draw_residuals(study.plastisol).axes
    # Two stated models, one accepted explanation.
    heights = [[bar.get_height() for bar in group] for group in axis.containers]
    fits = (*study.plastisol.stated, study.plastisol.verdict.best)
    assert heights == [pytest.approx(fit.residual) for fit in fits]


def test_quick_turns_end_at_90_deg_and_show_the_published_settling(study):
    axes = draw_quick_turns(study.plastisol).axes
    for axis, (base_only, *_) in zip(axes, published.TABLE_IV_SETTLE_S.values(), strict=True):
        dotted = [line for line in axis.lines if line.get_linestyle() == ":"]
        assert len(dotted) == 3
        assert all(line.get_ydata()[-1] == pytest.approx(90.0, abs=1e-3) for line in dotted)
        assert [line.get_xdata()[0] for line in axis.lines if line.get_linestyle() == "--"] == [
            base_only
        ]


def test_fits_are_drawn_in_the_order_of_aicc(study):
    (axis,) = draw_fits(study.plastisol).axes
    widths = [bar.get_width() for bar in axis.patches[:2]]
    fits = sorted(study.plastisol.fits, key=lambda f: f.aicc)
    assert widths == pytest.approx([f.rms_residual for f in fits])
