"""The published figures and their standard deviations."""

import math

import numpy as np
import pytest

from studies.published.experiments.figures import column_scatter, gelatin, plastisol


def test_the_figures_are_the_published_ones_and_none_of_the_compensators():
    values = [f.value for f in plastisol()]
    assert values == [0.37, 0.94, 1.39, 1.63, 0.67, 1.02, 27.0, 37.2]
    assert [f.value for f in gelatin()] == [0.17, 0.32, 0.49, 0.58]


def test_the_sigma_of_table_ii_is_its_scatter_about_its_line():
    depth = np.array([25.0, 50.0, 75.0, 100.0])[:, None]
    for figures in (plastisol()[:4], gelatin()):
        values = np.array([f.value for f in figures])
        _, squares, *_ = np.linalg.lstsq(depth, values, rcond=None)
        assert figures[0].sigma == pytest.approx(math.sqrt(squares[0] / 3))


def test_a_column_on_its_line_has_no_scatter():
    assert column_scatter({2.5: 0.25, 5.0: 0.5, 10.0: 1.0}) == pytest.approx(0.0, abs=1e-15)


def test_the_sigma_of_tables_iv_and_v_is_a_stated_fraction_and_their_rounding():
    # A last digit of 0.01 s leaves 0.01 / sqrt(12) s.
    assert plastisol(0.05)[4].sigma == pytest.approx(math.hypot(0.0335, 0.01 / math.sqrt(12)))
    assert plastisol(0.0)[7].sigma == pytest.approx(0.1 / math.sqrt(12))
    assert plastisol(0.05)[4].sigma_source == "5 % and rounding"
