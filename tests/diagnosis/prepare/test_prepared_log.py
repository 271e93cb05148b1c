"""A trial that can be replayed."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import prepared, trial, turns

from diagnosis.prepare.prepared_log import PreparedTrial
from sim.discretisation import Mesh


def test_a_depth_that_hardly_changes_is_constant():
    ready = prepared(trial(turns()))
    wobble = np.random.default_rng(1).uniform(-0.05, 0.05, ready.time_s.size)
    still = replace(ready, inserted_mm=90.0 + wobble)
    assert np.unique(still.schedule.inserted_mm) == pytest.approx([90.0], abs=0.05)
    assert still.schedule.mesh is Mesh.EULERIAN


def test_a_depth_that_grows_is_kept():
    ready = prepared(trial(turns()))
    deeper = replace(ready, inserted_mm=90.0 + ready.time_s, free_mm=ready.free_mm - ready.time_s)
    np.testing.assert_allclose(deeper.schedule.inserted_mm, 90.0 + deeper.schedule.time_s)
    assert deeper.schedule.mesh is Mesh.LAGRANGIAN


def test_a_replay_is_driven_by_the_motion_of_the_base():
    ready = prepared(trial(turns()))
    moved = replace(ready, base_motion_deg=ready.base_motion_deg + 1.0)
    driven = np.interp(ready.time_s, moved.schedule.time_s, moved.schedule.drive)
    np.testing.assert_allclose(driven, ready.base_motion_deg + 1.0, atol=1e-12)


def test_a_known_torque_at_the_tip_is_none_where_it_was_not_read():
    ready = prepared(trial(turns()))
    torque = np.where(ready.time_s < 1, np.nan, 0.3)
    schedule = replace(ready, tip_torque_n_mm=torque).schedule
    read = np.interp(ready.time_s, schedule.time_s, schedule.tip_torque_n_mm)
    np.testing.assert_allclose(read, np.nan_to_num(torque), atol=1e-12)


def test_a_sensor_that_gave_nothing_was_not_measured():
    ready = prepared(trial(turns()))
    assert isinstance(ready, PreparedTrial)
    empty = np.full(ready.time_s.size, np.nan)
    read = replace(ready, readings={"tip_angle_deg": empty, "base_torque_n_mm": 0 * empty + 1})
    assert not ready.has("tip_angle_deg")
    assert not read.has("tip_angle_deg")
    assert not read.has("base_torque_n_mm")
    assert replace(ready, readings={"tip_angle_deg": ready.time_s}).has("tip_angle_deg")
    assert ready.sample_s == pytest.approx(0.01)


def smooth(torque):
    """The smooth torque of a trial that reads this every 10 ms."""
    clean = trial(turns())
    return prepared(replace(clean, table=clean.table.assign(base_torque_n_mm=torque))).smooth_torque_n_mm


def test_a_torque_that_swings_is_followed_without_most_of_its_noise():
    """A cubic through n = 35 readings follows a cubic, and has 9 / 4n of the variance of one."""
    time = 0.01 * np.arange(turns().size)
    cubic = 0.1 * (time - 6.0) - 0.004 * (time - 6.0) ** 3
    np.testing.assert_allclose(smooth(cubic), cubic, atol=1e-9)
    noise = np.random.default_rng(4).normal(0, 1.0, time.size)
    inside = smooth(noise)[17:-17]
    # 1200 / 35 independent means tell a standard deviation to 1 / sqrt(2 x 34) = 12 %.
    assert np.std(inside) == pytest.approx(np.sqrt(9 / (4 * 35)), rel=3.5 * 0.12)


def test_a_torque_that_was_not_read_is_none():
    np.testing.assert_array_equal(prepared(trial(turns())).smooth_torque_n_mm, 0.0)
