"""Sensors and constants of a rig, against other rigs that must read the same."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns

from diagnosis.log.trial import SENSORS
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.replay.sensing.sensors import driven, reads_ahead, sensed
from sim.needles.run import SimulationFailed
from sim.schedule import Schedule

TIME = np.linspace(0, 10, 1001)

# Inertia does not scale with stiffness; of this needle it is 1e-6 of any torque.
LINEAR = {"rtol": 2e-6, "atol": 2e-5}


@pytest.fixture(scope="module")
def sliding():
    return prepared(trial(5.0 + turns(6.0), speed=-1.0))


def inputs(time_s, drive_deg=None):
    """A turn of the drive shaft at constant depth."""
    depth = np.full(time_s.shape, 50.0)
    return Schedule(
        time_s=time_s,
        drive=time_s if drive_deg is None else drive_deg,
        free_mm=depth,
        inserted_mm=depth,
        speed_mm_s=0 * depth,
    )


def same(sliding, *rigs, **tolerance):
    one, other = predict(RIG, sliding, rigs)
    for sensor in SENSORS:
        np.testing.assert_allclose(one[sensor], other[sensor], **(tolerance or LINEAR))


def test_delayed_sensors_show_what_was():
    rig = RigParameters(tip_delay_s=0.5, tip_scale=2.0, tip_bias_deg=3.0)
    tip, torque = sensed(rig, inputs(TIME), TIME, TIME)
    np.testing.assert_allclose(tip, 3 + 2 * np.maximum(TIME - 0.5, 0.0))
    np.testing.assert_array_equal(torque, TIME)


def test_the_torque_sensor_shows_needle_and_bearing_late_and_with_its_gain():
    rig = RigParameters(
        torque_delay_s=0.5, torque_scale=2.0, torque_bias_n_mm=3.0, drive_friction_n_mm=0.25
    )
    tip, torque = sensed(rig, inputs(TIME, 10 * TIME), TIME, TIME)
    seen = np.maximum(TIME - 0.5, 0.0)
    bearing = 0.25 * np.minimum(10 * seen / 0.1, 1.0)
    np.testing.assert_allclose(torque, 3 + 2 * (seen + bearing), atol=1e-9)
    np.testing.assert_array_equal(tip, TIME)


def test_a_clock_that_runs_off_shows_what_its_time_says():
    rig = RigParameters(tip_clock_ratio=0.9, torque_clock_ratio=0.8, torque_delay_s=0.5)
    tip, torque = sensed(rig, inputs(5.0 + TIME), TIME, TIME)
    np.testing.assert_allclose(tip, 0.9 * TIME, atol=1e-12)
    np.testing.assert_allclose(torque, np.maximum(0.8 * TIME - 0.5, 0.0), atol=1e-12)


def test_a_clock_that_ran_before_the_trial_is_late_by_its_rate_from_the_first_sample_on():
    """At 1 s of a trial, 3 s after they agreed, a clock that is slow by 10 % shows that at 0.7 s."""
    rig = RigParameters(tip_clock_ratio=0.9, torque_clock_ratio=0.9)
    tip, torque = sensed(rig, inputs(TIME), TIME, TIME, ran_s={"tip_angle_deg": 2.0})
    at = np.argmin(np.abs(TIME - 1.0))
    assert (tip[at], torque[at]) == pytest.approx((0.7, 0.9))


def test_a_fast_clock_that_ran_before_is_past_the_end_of_the_run_sooner():
    """By 10 % of 2 s more: of 10 s, its last samples that are known are at 8.9 and at 9.1 s."""
    rig, run_s = RigParameters(tip_clock_ratio=1.1), np.linspace(0.0, 10.0, 1001)
    for ran_s, last_s in (({"tip_angle_deg": 2.0}, 9.8 / 1.1), ({}, 10.0 / 1.1)):
        ahead = reads_ahead(rig, run_s, run_s, ran_s)["tip_angle_deg"]
        assert run_s[~ahead].max() == pytest.approx(last_s, abs=0.011)


def test_clocks_agree_where_the_recording_begins_and_not_where_the_rig_began_to_move():
    """A past of 2 s: at 1 s of the trial, a clock that is fast by 10 % shows the value at 1.1 s."""
    rig = RigParameters(tip_clock_ratio=1.1, torque_clock_ratio=0.9)
    tip, torque = sensed(rig, inputs(TIME), TIME, TIME, start_s=2.0)
    at = np.argmin(np.abs(TIME - 3.0))
    assert (tip[at], torque[at]) == pytest.approx((3.1, 2.9))


def test_a_low_pass_answers_a_ramp_as_its_equation_says():
    """tau y' = x - y with x = t from rest: y = t - tau (1 - exp(-t / tau)), at any step."""
    for tau in (0.002, 0.1):
        _, torque = sensed(RigParameters(torque_low_pass_s=tau), inputs(TIME), TIME, TIME)
        np.testing.assert_allclose(torque, TIME + tau * np.expm1(-TIME / tau), atol=1e-12)


def test_a_torque_gain_is_stiffness_and_damping_off_alike(sliding):
    scaled = RigParameters(stiffness_scale=1.1, damping_scale=1.1)
    same(sliding, RigParameters(torque_scale=1.1), scaled)


def test_a_gain_of_the_encoder_is_that_of_tip_stiffness_and_damping_the_other_way(sliding):
    scaled = RigParameters(tip_scale=1 / 1.05, stiffness_scale=1 / 1.05, damping_scale=1 / 1.05)
    same(sliding, RigParameters(base_scale=1.05), scaled)


def test_beside_dry_friction_neither_is_the_same(sliding):
    """Negative control: what does not scale with the others tells them apart."""
    dry = RigParameters(kinetic_n_mm_per_mm=0.001)
    for one, other in (
        (replace(dry, torque_scale=1.1), replace(dry, stiffness_scale=1.1, damping_scale=1.1)),
        (replace(dry, base_scale=1.05), replace(dry, tip_scale=1 / 1.05)),
    ):
        with pytest.raises(AssertionError):
            same(sliding, one, other, rtol=1e-3, atol=1e-3)


@pytest.mark.parametrize("growing", [False, True])
@pytest.mark.parametrize("share", [0.0, 1.0])
@pytest.mark.parametrize("offset", [12.0, -30.0])
def test_an_inserted_offset_is_a_log_of_another_depth(sliding, growing, offset, share):
    """The free length is as logged, or shorter by the offset."""
    speed = 2.0 if growing else 0.0
    depth = 90.0 + speed * sliding.time_s
    logged = replace(sliding, inserted_mm=depth, free_mm=60 - speed * sliding.time_s)
    rig = RigParameters(inserted_offset_mm=offset, offset_free_share=share)
    there = predict(RIG, logged, [rig])[0]
    free = logged.free_mm - share * offset
    here = predict(RIG, replace(logged, inserted_mm=depth + offset, free_mm=free), [NOMINAL])[0]
    for sensor in SENSORS:
        np.testing.assert_allclose(there[sensor], here[sensor], atol=1e-9)


def test_rigs_of_other_motion_and_depth_run_side_by_side(sliding):
    rigs = [NOMINAL, RigParameters(base_scale=0.9), RigParameters(inserted_offset_mm=-20.0)]
    for rig, together in zip(rigs, predict(RIG, sliding, rigs), strict=True):
        alone = predict(RIG, sliding, [rig])[0]
        for sensor in SENSORS:
            np.testing.assert_array_equal(together[sensor], alone[sensor])


def test_a_needle_that_never_reaches_the_tissue_cannot_be_simulated(sliding):
    with pytest.raises(SimulationFailed, match=r"inserted length above 0 mm, found 90\.0 mm"):
        driven(RigParameters(inserted_offset_mm=-90.0), sliding.schedule)


def test_a_tip_that_is_still_outside_has_no_depth(sliding):
    inserting = sliding.schedule
    inserting = replace(inserting, inserted_mm=np.linspace(0, 90, inserting.time_s.size))
    inserted = driven(RigParameters(inserted_offset_mm=-10.0), inserting).inserted_mm
    assert inserted[0] == 0.0
    assert inserted[-1] == pytest.approx(80.0)
