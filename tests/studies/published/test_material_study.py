"""What a study of one material holds."""

import numpy as np
import pytest
from reference_fits import LineReplay, fit_with, line_figures

from studies.published.material_study import compare_with_text


def test_text_figures_are_compared_with_the_stated_rig_and_each_leading_fit(study):
    verdict = study.plastisol.verdict
    figures = line_figures([3.0, 5.0], 0.1)
    fits = study.plastisol.fits
    compared = compare_with_text(figures, fit_with((), 4.0), fits, verdict, LineReplay())
    scale = [f.hypothesis.rig(f.x).model.damping_scale for f in verdict.leading]
    assert [c.figure for c in compared] == list(figures)
    assert [c.stated for c in compared] == [c.yielding for c in compared] == [1.0, 2.0]
    assert np.allclose([c.predicted for c in compared], np.outer([1.0, 2.0], scale))
    scale = [f.hypothesis.rig(f.x).model.damping_scale for f in fits]
    assert np.allclose([c.by_fit for c in compared], np.outer([1.0, 2.0], scale))
    # 1.0 predicted and 3.0 published, with 0.1 as standard deviation.
    assert compared[0].residual(1.0) == pytest.approx(-20.0)


def test_tissue_that_yields_as_stated_settles_later_than_the_stated_rig(study):
    lag, settling, left = study.plastisol.text
    assert lag.stated == pytest.approx(6.72, abs=0.01)
    assert lag.yielding < lag.stated
    assert settling.yielding > 2 * settling.stated
    # The slow pole of the 20 cm deep needle, 0.18 rad/s, leaves a good part of the turn after 6 s.
    assert left.stated < 2.0
    assert 8.0 < left.yielding < 9.0


def test_a_fit_is_compared_with_the_stated_rig_of_its_own_free_length(study):
    material = study.plastisol
    for fit in material.fits:
        assert material.stated_as(fit).hypothesis.base == fit.hypothesis.base


def test_singles_and_pairs_are_all_fits(study):
    material = study.plastisol
    assert (*material.singles(), *material.pairs()) == material.fits
    assert [f.hypothesis.names for f in material.pairs()] == [("base_servo", "shear_thinning")]
