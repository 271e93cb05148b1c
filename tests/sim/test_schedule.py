"""Inputs of a run, and what is wrong with bad ones."""

from dataclasses import replace

import numpy as np
import pytest

from models.errors import InvalidValue
from sim.discretisation import Mesh
from sim.schedule import Schedule


def columns(**changes):
    n = 4
    good = {
        "time_s": np.arange(n) * 0.5,
        "drive": np.zeros(n),
        "free_mm": np.full(n, 50.0),
        "inserted_mm": np.full(n, 100.0),
        "speed_mm_s": np.zeros(n),
    }
    return good | changes


@pytest.mark.parametrize("name", ["time_s", "drive", "free_mm", "inserted_mm", "speed_mm_s"])
@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_a_bad_number_is_named_with_its_row(name, bad):
    values = columns()[name].copy()
    values[2] = bad
    with pytest.raises(InvalidValue, match=rf"{name}\[2\]"):
        Schedule(**columns(**{name: values}))


@pytest.mark.parametrize("time", [[0, 0.5, 0.5, 1], [0, 1, 0.5, 2]])
def test_time_that_does_not_increase_is_named_with_its_row(time):
    with pytest.raises(InvalidValue, match=r"time_s\[2\].*sort"):
        Schedule(**columns(time_s=np.array(time)))


def test_columns_of_different_length_are_refused():
    with pytest.raises(InvalidValue, match="drive"):
        Schedule(**columns(drive=np.zeros(3)))


def test_a_single_sample_is_refused():
    one = {name: values[:1] for name, values in columns().items()}
    with pytest.raises(InvalidValue, match="at least two samples"):
        Schedule(**one)


def test_negative_lengths_are_refused():
    with pytest.raises(InvalidValue, match=r"free_mm\[1\]"):
        Schedule(**columns(free_mm=np.array([1.0, -1.0, 1.0, 1.0])))


def test_steps_reach_the_end_and_keep_the_inputs_straight():
    ramp = Schedule(**columns(drive=np.array([0.0, 10.0, 10.0, 40.0])))
    steps = ramp.at_steps(0.02)
    assert steps.time_s[-1] == pytest.approx(1.5)
    assert np.interp(0.25, steps.time_s, steps.drive) == pytest.approx(5.0)


def test_constant_depth_stands_in_the_tissue_and_growing_depth_goes_with_the_needle():
    assert Schedule(**columns()).mesh is Mesh.EULERIAN
    depth = np.array([0.0, 10.0, 20.0, 30.0])
    assert Schedule(**columns(inserted_mm=depth, free_mm=50 - depth)).mesh is Mesh.LAGRANGIAN
    fed = Schedule(**columns(inserted_mm=depth))
    assert (fed.mesh, fed.longest_mm) == (Mesh.FED, 80.0)


def test_a_needle_pulled_out_of_the_tissue_goes_with_the_chuck():
    depth = np.array([20.0, 0.0, 0.0, 0.0])
    assert (
        Schedule(**columns(inserted_mm=depth, free_mm=np.array([50.0, 70, 90, 110]))).mesh
        is Mesh.LAGRANGIAN
    )


def test_rows_keep_every_input():
    whole = Schedule(**columns(drive=np.arange(4.0)))
    part = whole.rows(whole.time_s >= 0.5)
    np.testing.assert_array_equal(part.time_s, [0.5, 1.0, 1.5])
    np.testing.assert_array_equal(part.drive, [1.0, 2.0, 3.0])
    assert part.tip_torque_n_mm.shape == (3,)


def test_inputs_are_resampled_once_for_each_step():
    ramp = Schedule(**columns(drive=np.arange(4.0)))
    assert ramp.at_steps(0.02) is ramp.at_steps(0.02)
    assert ramp.at_steps(0.01).time_s.size > ramp.at_steps(0.02).time_s.size
    turned = replace(ramp, drive=-ramp.drive)
    np.testing.assert_array_equal(turned.at_steps(0.02).drive, -ramp.at_steps(0.02).drive)
