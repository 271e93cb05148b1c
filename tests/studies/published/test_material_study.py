"""What a study of one material holds."""

import numpy as np
from reference_fits import LineReplay, fit_with, line_figures

from studies.published.material_study import compare_with_text


def test_text_figures_are_compared_with_the_stated_rig_and_each_leading_fit(study):
    verdict = study.plastisol.verdict
    figures = line_figures([3.0, 5.0], 0.1)
    compared = compare_with_text(figures, fit_with((), 4.0), verdict, LineReplay())
    scale = [f.hypothesis.rig(f.x).model.damping_scale for f in verdict.leading]
    assert [c.figure for c in compared] == list(figures)
    assert [c.stated for c in compared] == [1.0, 2.0]
    assert np.allclose([c.predicted for c in compared], np.outer([1.0, 2.0], scale))


def test_a_fit_is_compared_with_the_stated_rig_of_its_own_free_length(study):
    material = study.plastisol
    for fit in material.fits:
        assert material.stated_as(fit).hypothesis.base == fit.hypothesis.base


def test_singles_and_pairs_are_all_fits(study):
    material = study.plastisol
    assert (*material.singles(), *material.pairs()) == material.fits
    assert [f.hypothesis.names for f in material.pairs()] == [("base_servo", "shear_thinning")]
