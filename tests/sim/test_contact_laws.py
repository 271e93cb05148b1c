"""Laws of what a contact has been through, against closed forms.

The shaft is so stiff that all of it turns as its base does (its twist is below 0.02 deg). The slip is
then the angle turned, and the age of every contact, at a rate w with renewal d, that of

    d age / dt = 1 - age w / d:    age = d / w + (first age - d / w) exp(-w t / d).
"""

import numpy as np
import pytest
from stiff_shaft import ARRANGEMENTS, LENGTH_MM, STEP_S, curve, factor, turned

from models.tissue import Tissue


@ARRANGEMENTS
def test_friction_follows_the_slip_since_it_turned_back(arrangement):
    """Forwards by 180 deg, and back: what came before is forgotten within a few renewals of 0.3 deg."""
    bites = curve("turned_by", 20.0, 180.0, -1.2, renewal_deg=0.3)
    time_s, rate = np.arange(0, 8, STEP_S), 0.25 * np.pi
    angle_deg = np.degrees(rate) * np.minimum(time_s, 8.0 - time_s)
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=0.02, contact=bites)
    run = turned(tissue, time_s, angle_deg, arrangement=arrangement)
    # The way forwards, z, falls as (z + d) exp(-slip / d) - d: to 0 after d ln(1 + 180 / d) = 1.9 deg.
    forgetting_deg = 0.3 * np.log1p(180.0 / 0.3)
    slip_deg = np.degrees(rate) * np.where(run.time_s < 4.0, run.time_s, run.time_s - 4.0)
    since_deg = slip_deg - np.where(run.time_s < 4.0, 0.0, forgetting_deg)
    later = (run.time_s > 0.2) & ((run.time_s < 3.99) | (since_deg > 2.0))
    exact = 0.02 * LENGTH_MM * rate * np.where(run.time_s < 4.0, 1.0, -1.0)
    exact = exact * factor(bites, np.maximum(since_deg, 0.0))
    # The factor is late by a stage, 0.2 %; steps of 0.45 deg are coarse for 0.3: 0.2 deg, 0.6 %.
    np.testing.assert_allclose(run.base_torque_n_mm[later], exact[later], rtol=8e-3)
    assert run.base_torque_n_mm[30] / -run.base_torque_n_mm[-1] > 2.0


@ARRANGEMENTS
@pytest.mark.parametrize("rate", [0.8, -0.8])
def test_friction_follows_the_slip_so_far_in_both_directions(arrangement, rate):
    """The factor is that of the start of a stage: late by h, so off by h d log f / dt < 0.15 %."""
    lubricated = curve("slip", 30.0, 400.0, -1.2)
    time_s = np.arange(0, 6, STEP_S)
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=0.02, contact=lubricated)
    run = turned(tissue, time_s, np.degrees(rate) * time_s, arrangement=arrangement)
    slip_deg = np.degrees(abs(rate)) * run.time_s
    exact = 0.02 * LENGTH_MM * rate * factor(lubricated, slip_deg)
    np.testing.assert_allclose(run.base_torque_n_mm[20:], exact[20:], rtol=1.5e-3)
    assert exact[-1] / exact[20] < 0.5


def test_friction_follows_the_age_of_a_contact_that_slip_renews():
    """After 5 s of rest, at a constant rate. Late by a stage: h / decay < 0.6 % of the change."""
    rate, renewal_deg, rest_s, level = 0.4, 40.0, 5.0, 0.003
    ageing = curve("age", 0.2, 10.0, 1.5, renewal_deg=renewal_deg)
    time_s = np.arange(0, 12, STEP_S)
    drive_deg = np.degrees(rate) * np.maximum(time_s - rest_s, 0.0)
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=1e-9, kinetic_n_mm_per_mm=level, contact=ageing)
    run = turned(tissue, time_s, drive_deg)
    slides = run.time_s > rest_s + 0.05  # the presliding of 0.1 deg is over
    steady_s = np.radians(renewal_deg) / rate
    decay = np.exp(-(run.time_s[slides] - rest_s) / steady_s)
    exact = level * LENGTH_MM * factor(ageing, steady_s + (rest_s - steady_s) * decay)
    np.testing.assert_allclose(run.base_torque_n_mm[slides], exact, rtol=6e-3)
    assert exact[0] / exact[-1] > 1.3
    never_renewed = level * LENGTH_MM * factor(ageing, run.time_s[slides][-1])
    assert abs(never_renewed / exact[-1] - 1) > 0.3


def test_friction_follows_the_heat_of_slipping_of_late():
    """heat = w^2 (1 - exp(-t / fading)) at a constant rate. Late by a stage: h d log f / dt < 0.5 %."""
    rate, fading_s = 0.9, 1.5
    heated = curve("heat", 0.1, 1.0, -1.0, fading_s=fading_s)
    time_s = np.arange(0, 6, STEP_S)
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=0.02, contact=heated)
    run = turned(tissue, time_s, np.degrees(rate) * time_s)
    heat = -(rate**2) * np.expm1(-run.time_s / fading_s)
    exact = 0.02 * LENGTH_MM * rate * factor(heated, heat)
    np.testing.assert_allclose(run.base_torque_n_mm[20:], exact[20:], rtol=5e-3)
    assert exact[-1] / exact[20] < 0.6


def test_friction_follows_the_share_of_its_structure_that_slip_has_broken():
    """b = b1 (1 - exp(-k t)) at a rate w: k = w / renewal + 1 / fading, b1 = w / renewal / k.

    Late by a stage: h d log f / db db/dt < 0.01 * 1.3 * 0.5.
    """
    rate, renewal_deg, fading_s = 0.6, 40.0, 2.0
    broken = curve("broken", 1.0, 1.0, -1.5, renewal_deg=renewal_deg, fading_s=fading_s)
    time_s = np.arange(0, 6, STEP_S)
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=0.02, contact=broken)
    run = turned(tissue, time_s, np.degrees(rate) * time_s)
    breaks = rate / np.radians(renewal_deg)
    speed = breaks + 1.0 / fading_s
    share = -breaks / speed * np.expm1(-speed * run.time_s)
    exact = 0.02 * LENGTH_MM * rate * factor(broken, share)
    np.testing.assert_allclose(run.base_torque_n_mm[20:], exact[20:], rtol=8e-3)
    assert exact[-1] / exact[20] < 0.6


def test_a_level_curve_changes_nothing():
    time_s = np.arange(0, 3, STEP_S)
    law = {"viscous_n_mm_s_per_mm": 0.02, "kinetic_n_mm_per_mm": 0.002}
    level = curve("slip", 30.0, 400.0, 0.0)
    drive_deg = 40.0 * np.sin(2 * time_s)
    with_it = turned(Tissue.uniform(**law, contact=level), time_s, drive_deg)
    without = turned(Tissue.uniform(**law), time_s, drive_deg)
    np.testing.assert_allclose(with_it.base_torque_n_mm, without.base_torque_n_mm, atol=1e-9)


@ARRANGEMENTS
def test_friction_follows_the_share_of_fibres_that_lie_along_the_slip(arrangement):
    """Forwards n tends to 1 as 1 - exp(-x / d); back by x it is (1 + n) exp(-x / d) - 1."""
    renewal_deg, turn_deg = 26.0, 90.0
    nap = curve("aligned", 1.0, 1.0, -1.5, renewal_deg=renewal_deg)
    time_s, rate = np.arange(0, 8, STEP_S), np.radians(turn_deg) / 4.0
    angle_deg = np.degrees(rate) * np.minimum(time_s, 8.0 - time_s)
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=0.02, contact=nap)
    run = turned(tissue, time_s, angle_deg, arrangement=arrangement)
    forwards = run.time_s < 4.0
    slip_deg = np.degrees(rate) * np.where(forwards, run.time_s, run.time_s - 4.0)
    laid = -np.expm1(-turn_deg / renewal_deg)
    n = np.where(
        forwards, -np.expm1(-slip_deg / renewal_deg), (1 + laid) * np.exp(-slip_deg / renewal_deg) - 1
    )
    share = 0.5 * (1.0 + np.where(forwards, n, -n))
    exact = 0.02 * LENGTH_MM * rate * np.where(forwards, 1.0, -1.0) * factor(nap, share)
    later = (run.time_s > 0.1) & (np.abs(run.time_s - 4.0) > 0.1)
    # The factor is late by a stage, 0.2 deg of 26, over which its logarithm changes by 1.2 % at most.
    np.testing.assert_allclose(run.base_torque_n_mm[later], exact[later], rtol=1.2e-2)
    assert -run.base_torque_n_mm[410] / run.base_torque_n_mm[390] > 2.0


@ARRANGEMENTS
def test_bonds_begin_as_broken_as_they_are_given_and_heal_at_rest(arrangement):
    """At rest the share that is broken falls as exp(-t / fading); then the shaft slides."""
    bonds = curve("broken", 1.0, 1.0, -1.5, renewal_deg=1e6, fading_s=3.0, first_broken=0.6)
    time_s = np.arange(0, 6, STEP_S)
    rate = 0.2
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=0.02, contact=bonds)
    run = turned(tissue, time_s, np.degrees(rate) * time_s, arrangement=arrangement)
    exact = 0.02 * LENGTH_MM * rate * factor(bonds, 0.6 * np.exp(-run.time_s / 3.0))
    later = run.time_s > 0.1
    np.testing.assert_allclose(run.base_torque_n_mm[later], exact[later], rtol=5e-3)


def test_presliding_does_not_wear_a_dry_contact():
    """To and fro within the presliding angle nothing slips: the friction is as at first."""
    time_s = np.arange(0, 4, STEP_S)
    worn = curve("slip", 0.01, 0.2, -3.0)
    law = {"kinetic_n_mm_per_mm": 0.01}
    swing = 0.02 * np.sin(8.0 * time_s)  # deg: a fifth of the presliding angle
    with_it = turned(Tissue.uniform(**law, contact=worn), time_s, swing)
    without = turned(Tissue.uniform(**law), time_s, swing)
    np.testing.assert_allclose(with_it.base_torque_n_mm, without.base_torque_n_mm, atol=1e-9)
