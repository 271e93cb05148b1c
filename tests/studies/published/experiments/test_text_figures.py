"""Figures that the text gives in words."""

from studies.published.experiments.figures import gelatin, plastisol
from studies.published.experiments.text_figures import TEXT_FIGURES_GELATIN, TEXT_FIGURES_PLASTISOL


def test_the_text_says_a_lag_of_10_deg_and_a_settling_of_2_s_and_that_little_lag_is_left():
    assert [(f.value, f.unit) for f in TEXT_FIGURES_PLASTISOL] == [
        (10.0, "deg"),
        (2.0, "s"),
        (0.0, "deg"),
    ]
    assert [(f.value, f.unit) for f in TEXT_FIGURES_GELATIN] == [(0.0, "-")]


def test_no_fit_uses_a_figure_of_the_text():
    fitted = {f.name for f in (*plastisol(), *gelatin())}
    assert fitted.isdisjoint(f.name for f in (*TEXT_FIGURES_PLASTISOL, *TEXT_FIGURES_GELATIN))
