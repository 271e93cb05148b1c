"""Tissue that breathes, beats, or turns to and fro."""

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns
from free_forms import covered_by

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Place
from diagnosis.freeform.families.in_time.waves import families, strongest_wave_hz
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(8.0)
TIME = 0.01 * np.arange(ANGLE.size)
REST = np.zeros(ANGLE.size)
NONE = (0.0, 0.0)  # of a second harmonic
CHANGE = 0.3 * np.sin(2.0 * TIME)
"""What less damping changes, deg; the noise is NOISE."""


def log_that_breathes(rate_hz, size=4.0, count=3):
    """Ranges of trials whose residual is that change times a wave, from another phase in each."""
    rng = np.random.default_rng(5)
    waves = [np.cos(2 * np.pi * rate_hz * TIME + 2.0 * i) for i in range(count)]
    tips = [size * CHANGE * wave + rng.normal(0, 0.25, TIME.size) for wave in waves]
    seen = [(ANGLE, tip, (REST, REST)) for tip in tips]
    return covered_by(seen, softer=[(CHANGE, REST)] * count)


@pytest.mark.parametrize("rate_hz", [0.6, 1.1, 1.7])
def test_the_rate_of_a_breath_is_found_in_noise(rate_hz):
    """To half of the step between rates, 0.5 / 8 s."""
    assert strongest_wave_hz(log_that_breathes(rate_hz)) == pytest.approx(rate_hz, abs=0.5 / 8)


def breathing():
    return next(f for f in families(log_that_breathes(0.6)) if f.name == "damping over time, as a wave")


def test_a_breath_has_a_phase_of_its_own_in_each_trial():
    family = breathing()
    assert (family.place, family.says, family.effect.trial) == (Place.TISSUE, "time", "")
    assert family.of_each_trial
    first, second, _ = family.effect.apply(NOMINAL, 2.0, *NONE, 0.3, 0.0, 0.0, 0.2, 0.0, 0.0).free.curves
    at = np.array([0.0, 0.5, 1.0, 2.0, 2.5])
    # A sine through 16 places is off by (2 pi / 16)^4 / 384 = 0.006 %; its exponential by little more.
    np.testing.assert_allclose(first.at(at), np.exp(0.3 * np.cos(np.pi * at)), rtol=1e-3)
    np.testing.assert_allclose(second.at(at), np.exp(0.2 * np.sin(np.pi * at)), rtol=1e-3)
    x, y = family.curve(2.0, *NONE, 0.3, 0.0, 0.0, 0.2, 0.0, 0.0)
    assert (x[0], x[-1]) == (0.0, 2.0)
    assert y[0] == pytest.approx(y[-1])


def test_trials_share_the_shape_of_a_wave_and_have_its_phase_each():
    """Two harmonics: the wave of another trial is the same one, earlier by a phase, half as large."""
    turning = next(
        f for f in families(log_that_turns(0.6)) if f.name == "tissue angle over time, as a wave"
    )
    early, size, second = 0.7, 0.5, (0.3, -0.2)
    own = [size * np.cos(early), -size * np.sin(early)]
    curves = turning.effect.apply(NOMINAL, 2.0, *second, 1.0, 0.0, *own, 0.0, 0.0).free.curves
    at = np.linspace(0.0, 2.0, 9)
    first, other, none = (curve.at(at) for curve in curves)
    phase = np.pi * at
    b = complex(*second)
    np.testing.assert_allclose(first, np.cos(phase) + (b * np.exp(2j * phase)).real, atol=2e-3)
    later = phase + early
    expected = size * (np.cos(later) + (b * np.exp(2j * later)).real)
    np.testing.assert_allclose(other, expected, atol=2e-3)
    np.testing.assert_array_equal(none, 0.0)


def test_tissue_that_does_not_breathe_is_the_nominal_one():
    own = prepared(trial(ANGLE, name="trial_02.csv"))
    still, swells = (breathing().effect.apply(NOMINAL, 2.0, *NONE, *[c] * 6) for c in (0.0, 0.3))
    found, other, expected = predict(RIG, own, [still, swells, NOMINAL])
    np.testing.assert_allclose(found.tip_angle_deg, expected.tip_angle_deg, atol=1e-6)
    assert np.abs(other.tip_angle_deg - expected.tip_angle_deg).max() > 0.1


def test_dry_friction_that_does_not_pulse_is_even_friction():
    pulses = next(
        f for f in families(log_that_breathes(0.6)) if f.name == "dry friction over time, as a wave"
    )
    own = prepared(trial(ANGLE, name="trial_02.csv"))
    still, swells = (pulses.effect.apply(NOMINAL, 0.003, 2.0, *NONE, *[c] * 6) for c in (0.0, 0.5))
    even = LIBRARY["coulomb_friction"].apply(NOMINAL, 0.003)
    found, other = predict(RIG, own, [still, swells])
    (expected,) = predict(RIG, own, [even])
    np.testing.assert_allclose(found.tip_angle_deg, expected.tip_angle_deg, atol=1e-6)
    assert np.abs(other.tip_angle_deg - expected.tip_angle_deg).max() > 0.1
    _, level = pulses.curve(0.003, 2.0, *NONE, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0)
    assert level[0] == pytest.approx(0.003 * np.exp(0.5))


def log_that_turns(rate_hz, count=3):
    """Ranges of trials in which the tip turns to and fro, whatever else it does."""
    rng = np.random.default_rng(5)
    waves = [np.sin(2 * np.pi * rate_hz * TIME + 2.0 * i) for i in range(count)]
    tips = [3.0 * wave + rng.normal(0, 0.25, TIME.size) for wave in waves]
    seen = [(ANGLE, tip, (REST, REST)) for tip in tips]
    return covered_by(seen, softer=[(CHANGE, REST)] * count)


@pytest.mark.parametrize("rate_hz", [0.6, 1.1, 1.7])
def test_the_rate_at_which_the_tissue_turns_is_found_in_noise(rate_hz):
    found = strongest_wave_hz(log_that_turns(rate_hz), of_damping=False)
    assert found == pytest.approx(rate_hz, abs=0.5 / 8)


def test_tissue_that_turns_takes_the_needle_with_it():
    """As seen from the tissue the drive turns back: a base that turns with the tissue feels nothing."""
    turning = next(
        f for f in families(log_that_turns(0.6)) if f.name == "tissue angle over time, as a wave"
    )
    assert (turning.place, turning.says) == (Place.TISSUE, "time")
    rig = turning.effect.apply(NOMINAL, 2.0, *NONE, 0.0, 5.0, *[0.0] * 4)
    wave = 5.0 * np.sin(np.pi * TIME)
    with_it = prepared(trial(wave, name="trial_01.csv"))
    (found,) = predict(RIG, with_it, [rig])
    np.testing.assert_allclose(found.tip_angle_deg, wave, atol=2e-3)  # the spline is off by 0.006 %
    np.testing.assert_allclose(found.base_torque_n_mm, 0.0, atol=1e-4)
    still = prepared(trial(REST, name="trial_01.csv"))
    (held,) = predict(RIG, still, [rig])
    back = prepared(trial(-wave, name="trial_01.csv"))
    (turned,) = predict(RIG, back, [NOMINAL])
    np.testing.assert_allclose(held.base_torque_n_mm, turned.base_torque_n_mm, atol=1e-4)
    np.testing.assert_allclose(held.tip_angle_deg, turned.tip_angle_deg + wave, atol=5e-3)
