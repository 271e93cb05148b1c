"""Comparison of rigs in units of the noise of the log's sensors."""

from dataclasses import replace

import numpy as np
import pytest

from validation.logs.comparison import RigComparison, rms
from validation.logs.sensors import TIP, TORQUE


@pytest.fixture
def trial(drive):
    """One trial, short."""
    return drive(dt=0.0025, end=2.0)


def test_a_rig_does_not_differ_from_itself(trial, sensors, make_rig):
    comparison = RigComparison([trial], sensors)
    assert comparison.signature(make_rig(), make_rig()) == 0.0


def test_a_bias_has_the_signature_of_its_size_over_the_noise(trial, sensors, make_rig):
    """Of two signals one differs, by 3 sigma everywhere: the root mean square is 3 / sqrt(2)."""
    comparison = RigComparison([trial], sensors)
    biased = make_rig(tip_angle_bias={"bias": 3 * sensors.noise[TIP]})
    assert comparison.signature(biased, make_rig()) == pytest.approx(3 / np.sqrt(2))
    alone = RigComparison([trial], replace(sensors, missing=TORQUE))
    assert alone.signature(biased, make_rig()) == pytest.approx(3.0)


def test_the_other_rig_is_driven_by_the_base_angle_that_is_shown(trial, sensors, make_rig):
    """An encoder's error reaches a replay as its drive: the tip then differs, the base does not."""
    comparison = RigComparison([trial], sensors)
    eccentric = make_rig({"eccentric_encoder": {"amplitude": 5.0, "phase": 0.0}})
    shown = comparison.signals(eccentric)
    replayed = comparison.signals(make_rig(), shown)
    assert (replayed[0].base_deg == shown[0].base_deg).all()
    assert comparison.signature(eccentric, make_rig()) > 1.0


def test_a_rig_is_simulated_once(trial, sensors, make_rig):
    comparison = RigComparison([trial], sensors)
    assert comparison.signals(make_rig()) is comparison.signals(make_rig())


def test_a_coarse_comparison_is_good_to_a_few_hundredths(trial, sensors, make_rig):
    dry = make_rig(coulomb_friction={"level": 0.002})
    fine, coarse = (RigComparison([trial], sensors, coarse=c) for c in (False, True))
    assert coarse.motions[0].dt_s == pytest.approx(4 * trial.dt_s)
    assert (coarse.motions[0].base_deg == trial.base_deg[::4]).all()
    expected = fine.signature(dry, make_rig())
    assert coarse.signature(dry, make_rig()) == pytest.approx(expected, rel=0.05)


def test_rms_of_a_sine_is_its_amplitude_over_the_root_of_two():
    phase = np.linspace(0, 2 * np.pi, 1001)[:-1]
    assert rms(3 * np.sin(phase)) == pytest.approx(3 / np.sqrt(2))
