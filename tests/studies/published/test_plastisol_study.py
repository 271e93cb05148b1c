"""The study of plastisol."""

import pytest
from reference_fits import fit_with

from studies.published import plastisol_study
from studies.published.experiments.rig import WITHOUT_FREE_LENGTH
from studies.published.fitting.hypothesis import of_plastisol


def test_the_stated_model_is_rejected_and_a_soft_servo_with_shear_thinning_is_consistent(study):
    found = study.plastisol
    assert [s.rms_residual for s in found.stated] == pytest.approx([7.5, 3.5], abs=0.05)
    assert found.verdict.effects == ("base_servo", "shear_thinning")
    # Of docs/published-figures.md, where many more hypotheses are fitted.
    assert found.verdict.best.rms_residual == pytest.approx(0.83, abs=0.005)
    assert found.verdict.best.p_value == pytest.approx(0.36, abs=0.005)


def test_the_servo_alone_leaves_an_integral_that_it_can_explain_by_itself(study):
    (alone,) = study.plastisol.singles()
    assert alone.aicc == pytest.approx(21.1, abs=0.05)
    assert study.plastisol.unattainable[alone.hypothesis] == ()


def test_fits_of_single_mechanisms_start_from_the_damping_fitted_first():
    given = []

    class Fitter:
        def fit(self, hypothesis, starts):
            given.append((hypothesis.names[0], len(starts)))
            return fit_with(hypothesis.names, 1.0, parameters=1)

    singles = [of_plastisol(WITHOUT_FREE_LENGTH, n) for n in ("damping_error", "base_servo")]
    plastisol_study._fit_singles(Fitter(), singles, lambda what, share: None)
    # The servo has two starts of its own, and both again at the damping that was found.
    assert given == [("damping_error", 1), ("base_servo", 4)]
