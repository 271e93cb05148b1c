"""What an effect changes beside half of an explanation: closed forms of gains and offsets."""

import numpy as np
import pytest
from diagnosis_fixtures import coarse_of, log_of

from diagnosis.fitting.fit import fit_effects
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.candidate import candidate
from diagnosis.selection.equivalence.effect_change import change_of
from diagnosis.selection.equivalence.noiseless_log import noiseless_log


def log_of_effect(name, value):
    """The noiseless log of an effect as strong as told, in units of a fit."""
    coarse = coarse_of(log_of(NOMINAL, seconds=6.0))
    start = coarse.parameterization((name,)).joined({name: np.array([value])})
    return noiseless_log(coarse, candidate(fit_effects(coarse, (name,), start, most_iterations=0)), ())


@pytest.fixture(scope="module")
def log():
    """A log of an offset of the torque."""
    return log_of_effect("torque_bias", 0.4)


def test_of_an_effect_that_is_named_the_other_half_is_its_change(log):
    change = change_of(log, "torque_bias")
    np.testing.assert_allclose(change.change, log.changed - log.middle, atol=1e-9)
    np.testing.assert_allclose(change.part, 0.5 * log.own["torque_bias"])


def test_an_effect_of_another_sensor_changes_other_readings(log):
    change = change_of(log, "tip_angle_bias").change
    assert abs(change @ log.changed) < 1e-9 * np.sqrt(log.power * (change @ change))


@pytest.mark.parametrize("level_n_mm_per_mm", [0.0002, 0.004])
def test_what_changes_alike_is_taken_as_strong_as_the_half_that_is_left(level_n_mm_per_mm):
    """Stiction is dry friction, but for the first slip: whatever the strength from which it starts."""
    log = log_of_effect("coulomb_friction", np.log(level_n_mm_per_mm))
    change = change_of(log, "stiction").change
    assert change @ log.middle / (log.middle @ log.middle) == pytest.approx(1.0, rel=0.3)
