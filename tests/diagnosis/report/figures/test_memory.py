"""Spectrum and memory of the residual, in pictures."""

from dataclasses import replace

import numpy as np
import pytest

from diagnosis.report.figures.memory import describe_memory, draw_memory


def test_spectra_are_those_of_the_assessment_beside_white_noise(dry):
    axis = draw_memory(dry.found).axes[0]
    shape = dry.found.assessment.shape.spectrum["base_torque_n_mm"]
    nominal, _, explained, white = axis.get_lines()
    np.testing.assert_array_equal(nominal.get_xydata(), shape.power_per_hz)
    assert [line.get_label() for line in (nominal, explained, white)] == [
        "nominal",
        "explained",
        "white noise",
    ]
    assert set(white.get_ydata()) == {shape.white_per_hz}


def test_the_power_has_a_number_at_both_ends_however_flat_a_spectrum_is(dry):
    told = dry.found.assessment
    flat = {
        s: replace(p, power_per_hz=((0.1, 0.02), (10.0, 0.03))) for s, p in told.shape.spectrum.items()
    }
    shape = replace(told.shape, spectrum=flat)
    found = replace(dry.found, assessment=replace(told, shape=shape, shape_after=shape))
    low, high = np.log10(draw_memory(found).axes[0].get_ylim())
    assert (low, high) == pytest.approx((np.round(low), np.round(high)))
    assert low < high


def test_the_autocorrelation_falls_into_the_band_of_white_noise(dry):
    axis = draw_memory(dry.found).axes[1]
    before, after = (line.get_ydata() for line in axis.get_lines())
    (band,) = axis.patches
    limit = band.get_height() / 2
    own = dry.found.assessment.shape_after.autocorrelation["base_torque_n_mm"]
    assert limit == pytest.approx(own.white_limit)
    assert before[0] > 0.5
    assert np.mean(np.abs(after) > limit) < 0.25


def test_words_have_the_correlation_from_one_sample_to_the_next(dry):
    told = dry.found.assessment
    before, after = (
        s.autocorrelation["tip_angle_deg"].lag_one_correlation for s in (told.shape, told.shape_after)
    )
    assert f"tip {before:.2f}, explained {after:.2f}" in describe_memory(dry.found)


def test_a_residual_without_spectrum_or_memory_is_left_out(dry):
    told = dry.found.assessment
    nothing = replace(told.shape, spectrum={}, autocorrelation={})
    bare = replace(dry.found, assessment=replace(told, shape=nothing, shape_after=nothing))
    assert [len(axis.get_lines()) for axis in draw_memory(bare).axes] == [0] * 4
