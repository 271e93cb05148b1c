"""What rig.yaml describes."""

import math

import pytest
from diagnosis_fixtures import RIG

from diagnosis.log.nominal_rig import NominalRig, SensorNoise
from models.errors import InvalidValue


def test_rigidity_is_that_of_a_round_bar():
    """kappa = G pi d^4 / 32, with G in N / mm^2."""
    assert RIG.rigidity_n_mm2 == pytest.approx(27.2e3 * math.pi * 0.59**4 / 32)


def test_claimed_noise_is_by_the_column_that_a_sensor_fills():
    claims = SensorNoise(tip_angle_noise_deg=1, base_torque_noise_n_mm=2, base_angle_noise_deg=3)
    by_column = {"tip_angle_deg": 1, "base_torque_n_mm": 2, "base_angle_deg": 3}
    assert claims.by_column() == by_column


def test_a_rig_without_trials_is_no_rig():
    with pytest.raises(InvalidValue, match="trials"):
        NominalRig(**{**dict(RIG), "trials": ()})
