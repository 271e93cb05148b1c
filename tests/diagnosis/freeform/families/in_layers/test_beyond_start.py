"""Tissue that the needle had not been in before the trial."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import NOISE, RIG, log_with, prepared, trial, turns
from free_forms import DAMPING, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.fitting.nuisance import nuisance_of
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.families.in_layers.beyond_start import families
from diagnosis.freeform.ranges import ranges_of
from diagnosis.prepare.prepare import prepare
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.replay import predict
from diagnosis.replay.resolution import FINE
from diagnosis.replay.rig_parameters import NOMINAL

ANGLE = turns(6.0)
NO_FRICTION = 1e-12


def sliding(angle, speed):
    """A trial without readings, of a needle that is 60 mm deep and goes deeper at a speed."""
    one = trial(np.asarray(angle, float), speed=speed)
    return replace(one, table=one.table.assign(inserted_mm=60.0 + speed * one.table["time_s"]))


def found(speed):
    one = sliding(ANGLE, speed)
    read = one.table.assign(tip_angle_deg=ANGLE)
    ready = prepare(log_with(replace(one, table=read)))[0]
    problem = FitProblem(log=ready, noise=NOISE, nuisance=nuisance_of(ready))
    none = np.zeros(ANGLE.size)
    return families(ranges_of(problem, [Prediction(tip_angle_deg=none, base_torque_n_mm=none)]))


(FAMILY,) = found(2.0)


def test_a_needle_that_does_not_slide_has_no_such_law():
    assert found(0.0) == ()


def test_where_a_needle_goes_no_deeper_the_law_changes_nothing():
    """The mesh is that of two layers: second order in its elements."""
    assert same_readings(ANGLE, FAMILY.effect.apply(NOMINAL, 3.0, 0.002), NOMINAL, within=1e-3)


def growing(rig, speed):
    """Readings of a needle that goes in at a speed, turned at an even rate."""
    one = sliding(20.0 * np.arange(0, 8.0, 0.01), speed)
    return predict(RIG, prepared(one), [rig], FINE)[0]


def test_what_lies_beyond_the_start_resists_as_much_more_as_the_law_says():
    """At an even rate the whole shaft turns alike: the torque is the sum of damping times rate.

    Of 16 mm beyond 60 mm, with three times the damping, as of 60 + 3 x 16 = 108 mm for 76 mm.
    """
    plain, fresh = (
        growing(rig, 2.0) for rig in (NOMINAL, FAMILY.effect.apply(NOMINAL, 3.0, NO_FRICTION))
    )
    last = slice(-20, None)
    ratio = np.mean(fresh.base_torque_n_mm[last]) / np.mean(plain.base_torque_n_mm[last])
    assert ratio == pytest.approx(108.0 / 76.0, rel=0.02)


def test_as_strong_as_the_rest_it_is_the_nominal_rig():
    plain, same = (
        growing(rig, 2.0) for rig in (NOMINAL, FAMILY.effect.apply(NOMINAL, 1.0, NO_FRICTION))
    )
    span = np.ptp(plain.base_torque_n_mm)
    np.testing.assert_allclose(same.base_torque_n_mm, plain.base_torque_n_mm, atol=2e-3 * span)


def test_of_a_trial_that_begins_at_the_surface_it_is_all_the_tissue():
    thick = LIBRARY["damping_error"].apply(NOMINAL, 2.0)
    law = FAMILY.effect.apply(NOMINAL, 2.0, NO_FRICTION).free
    assert law.begun_at(0.0, 0.0, 0.0).along_depth.thicknesses_mm[0] < 0.01
    assert law.begun_at(0.0, 0.0, 0.0).along_depth.damping[-1] == thick.damping_scale


def test_the_curve_is_told_on_either_side_of_the_start():
    x, y = FAMILY.curve(3.0, 0.001)
    assert x[0] < 0.0 < x[-1]
    np.testing.assert_allclose(y, [DAMPING, DAMPING, 3.0 * DAMPING, 3.0 * DAMPING])
