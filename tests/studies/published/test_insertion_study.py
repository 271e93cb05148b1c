"""Figs. 11 and 12 under hypotheses: values that 12 mm asks for, and what follows from them."""

import math
from dataclasses import replace

import pytest

from diagnosis.effects.effect import Parameter
from diagnosis.replay.rig_parameters import RigParameters
from studies.published import insertion_study
from studies.published.experiments.insertion import InsertionRig
from studies.published.fitting.insertion_hypotheses import InsertionHypothesis, prebend_torque_n_mm
from studies.published.insertion_study import sigma_mm, value_for_base_alone


def hypothesis(low, high):
    parameter = Parameter(name="value", unit="mm", low=low, high=high, start=(low,), logarithmic=True)
    return InsertionHypothesis(
        name="x", parameter=parameter, apply=lambda value: InsertionRig(shaft_mm=value)
    )


@pytest.mark.parametrize(
    ("deviation", "low", "high", "value"),
    [
        (lambda length: 0.1 * length, 20.0, 500.0, 120.0),
        (lambda length: 3600.0 / length, 60.0, 400.0, 300.0),  # falls, as with the rate of the base
        (lambda length: 24 - abs(length - 200) / 10, 20.0, 500.0, 80.0),  # the nearer of two values
    ],
)
def test_the_value_that_gives_12_mm_is_found(monkeypatch, deviation, low, high, value):
    monkeypatch.setattr(
        insertion_study, "deviations_alone_mm", lambda rigs: [deviation(rig.shaft_mm) for rig in rigs]
    )
    # Straight in the logarithm over 1 / 81 of a range of e^3.2: error (0.04)^2 / 8.
    assert value_for_base_alone(hypothesis(low, high)) == pytest.approx(value, rel=3e-4)


def test_where_no_value_gives_12_mm_the_nearer_end_is_shown(monkeypatch):
    monkeypatch.setattr(
        insertion_study, "deviations_alone_mm", lambda rigs: [rig.shaft_mm / 100 for rig in rigs]
    )
    far = hypothesis(100.0, 300.0)
    assert math.isnan(value_for_base_alone(far))
    assert insertion_study._nearest_end(far) == 300.0


def test_the_sigma_of_a_deviation_is_a_tenth_and_its_rounding():
    assert sigma_mm(12.0) == pytest.approx(math.sqrt(1.2**2 + 1 / 12))
    assert sigma_mm(0.0) == pytest.approx(1 / math.sqrt(12))


def test_residuals_are_in_standard_deviations(study):
    stated = study.insertions.stated
    exact = replace(stated, alone_mm=12.0, compensated_mm=4.0)
    assert (exact.residual, exact.rms_residual, exact.meets_both) == ((0.0, 0.0), 0.0, True)
    off = replace(exact, compensated_mm=4.0 + 2.1 * sigma_mm(4.0))
    assert not off.meets_both
    assert off.rms_residual == pytest.approx(2.1 / math.sqrt(2))


def test_a_hypothesis_that_misses_figures_of_the_text_by_more_is_said_to(study):
    found = study.insertions
    lag, settling, left = found.stated.text
    worse = replace(found.stated, text=(lag + 10.0, settling, left))
    assert found.worsened(found.stated) == ()
    assert found.worsened(worse) == ("Fig. 3, lag, 10 cm",)


def test_larger_damping_meets_fig_12_and_spoils_figs_3_and_5(study):
    """Compensated, the needle of 3.25 times the damping is a prediction; so is its lag."""
    found = next(p for p in study.insertions.predictions if p.hypothesis.name == "larger damping")
    assert found.alone_mm == pytest.approx(12.0, abs=0.05)
    assert found.compensated_mm == pytest.approx(4.5, abs=0.1)
    # Equation (2): the lag goes with the damping, but for what has not built up by the end.
    assert found.text[0] == pytest.approx(found.value * study.insertions.stated.text[0], rel=0.02)
    assert len(study.insertions.worsened(found)) == 3


def test_fits_to_the_tables_take_their_tissue_and_motion_along(study):
    fit = study.plastisol.verdict.best
    made = insertion_study.of_fit(fit, 330.0)
    rig = made.apply(math.nan)
    assert rig.turn == fit.hypothesis.rig(fit.x).turn
    assert rig.model.rate_exponent == fit.hypothesis.rig(fit.x).model.rate_exponent != 1.0
    assert made.of_tables
    assert rig.shaft_mm == 330.0
    assert "no free length" in made.basis


def test_the_best_fit_is_also_given_a_prebent_tip_whose_channel_gives(study):
    found = next(
        p for p in study.insertions.predictions if math.isfinite(p.value) and p.hypothesis.of_tables
    )
    assert found.hypothesis.basis.endswith("330 mm of shaft")
    assert 0.0 < found.value < prebend_torque_n_mm()
    # Straight between values a ninth of the range apart.
    assert found.alone_mm == pytest.approx(12.0, abs=0.3)
    without = next(
        p
        for p in study.insertions.predictions
        if p.hypothesis.basis == found.hypothesis.basis and not p.hypothesis.parameter
    )
    assert without.alone_mm < 10.0
    assert found.text == without.text


def test_what_acts_at_the_tip_is_absent_where_the_tip_is_outside_the_tissue():
    rig = InsertionRig(
        model=RigParameters(
            tip_drag_n_mm_s_per_rad=1.0, curvature_n_mm_per_mm=0.1, kinetic_n_mm_per_mm=0.01
        )
    )
    seen = insertion_study._through_tissue(rig)
    assert seen.model == RigParameters(kinetic_n_mm_per_mm=0.01)
    assert seen.free_mm == 50.0
