"""Laws of what a contact has been through, and a chuck that slips, against closed forms.

The shaft is so stiff that all of it turns as its base does (its twist is below 0.02 deg). The slip is
then the angle turned, and the age of every contact, at a rate w with renewal d, that of

    d age / dt = 1 - age w / d:    age = d / w + (first age - d / w) exp(-w t / d).
"""

import numpy as np
import pytest

from models.contact import CONTACT_POINTS, ContactCurve, contact_places
from models.drive import Drive
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation
from sim.kernel import memory_map
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate

STIFF = NITINOL.but(shear_modulus_gpa=1e6)
LENGTH_MM, STEP_S = 60.0, 0.01
ARRANGEMENTS = pytest.mark.parametrize("arrangement", list(Arrangement))


def turned(tissue, time_s, drive_deg, *, arrangement=Arrangement.SIBLINGS, drive=None):
    same = np.ones(time_s.size)
    setup = Setup(
        needle=STIFF,
        tissue=tissue,
        drive=drive or Drive(),
        free_mm=10.0,
        inserted_mm=LENGTH_MM,
        discretisation=Discretisation(elements=8, step_s=STEP_S, arrangement=arrangement),
    )
    inputs = Schedule(
        time_s=time_s,
        drive=drive_deg,
        free_mm=10.0 * same,
        inserted_mm=LENGTH_MM * same,
        speed_mm_s=0.0 * same,
    )
    return simulate([setup], inputs)[0]


def curve(over, scale, last, steepness, **more):
    factors = np.exp(steepness * np.linspace(0, 1, CONTACT_POINTS) ** 2)
    return ContactCurve(over=over, scale=scale, last=last, factors=tuple(factors), **more)


def factor(own, at):
    """The curve in between: straight in the logarithms."""
    u = np.log1p(own.places / own.scale)
    return np.exp(np.interp(np.log1p(at / own.scale), u, np.log(own.factors)))


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
@pytest.mark.parametrize("rate", [1.5, -1.5])
def test_a_chuck_holds_its_torque_and_slips_by_the_rest(arrangement, rate):
    """In viscous tissue a needle that takes the torque T turns at T / (damping length)."""
    damping, grip = 0.02, 0.9
    time_s = np.arange(0, 4, STEP_S)
    drive_deg = np.degrees(rate) * time_s
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=damping)
    drive = Drive(grip_torque_n_mm=grip)
    run = turned(tissue, time_s, drive_deg, arrangement=arrangement, drive=drive)
    turns = grip / (damping * LENGTH_MM)
    assert turns < abs(rate)
    np.testing.assert_allclose(run.base_torque_n_mm[5:], np.sign(rate) * grip, rtol=1e-6)
    seconds = run.time_s[-1] - run.time_s[5]
    turned_deg = run.tip_deg[-1] - run.tip_deg[5]
    assert turned_deg == pytest.approx(np.degrees(np.sign(rate) * turns * seconds), rel=1e-6)
    slip = run.outputs[:, memory_map.O_CHUCK_SLIP]
    assert slip[-1] - slip[5] == pytest.approx((rate - np.sign(rate) * turns) * seconds, rel=1e-6)


@ARRANGEMENTS
@pytest.mark.parametrize("rate", [1.5, -1.5])
def test_a_spring_beside_the_grip_takes_up_the_rest_until_the_stop(arrangement, rate):
    """With damping D of the whole shaft, torque = grip + spring s and ds / dt = rate - torque / D:

    torque = D rate - (D rate - grip) exp(-spring t / D),    until s comes to the stop.
    """
    damping, grip, spring, stop_deg = 0.02 * LENGTH_MM, 0.5, 0.8, 60.0
    time_s = np.arange(0, 5, STEP_S)
    drive = Drive(grip_torque_n_mm=grip, grip_stiffness_n_mm_per_rad=spring, grip_play_deg=2 * stop_deg)
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=0.02)
    run = turned(tissue, time_s, np.degrees(rate) * time_s, arrangement=arrangement, drive=drive)
    left = (damping * abs(rate) - grip) * np.exp(-spring * run.time_s / damping)
    slip = (damping * abs(rate) - grip - left) / spring
    before = (slip < np.radians(stop_deg)) & (run.time_s > 5 * STEP_S)
    assert 20 < before.sum() < 0.9 * time_s.size
    exact = np.sign(rate) * (damping * abs(rate) - left)
    # The servo moves in steps: its first torque is late by half of one, 0.5 spring h / D.
    late = 0.5 * spring * STEP_S / damping
    np.testing.assert_allclose(run.base_torque_n_mm[before], exact[before], rtol=2 * late)
    stopped = run.time_s > run.time_s[before][-1] + 0.2
    np.testing.assert_allclose(run.base_torque_n_mm[stopped], damping * rate, rtol=1e-6)
    slip = run.outputs[stopped, memory_map.O_CHUCK_SLIP]
    np.testing.assert_allclose(slip, np.sign(rate) * np.radians(stop_deg), rtol=1e-9)


@pytest.mark.parametrize("more", [{}, {"grip_play_deg": 50}, {"grip_stiffness_n_mm_per_rad": 0.7}])
@ARRANGEMENTS
def test_what_slips_in_the_chuck_becomes_heat(arrangement, more):
    """Work of the drive = heat + what is stored; presliding stores 0.1 deg of 80, 1 part in 500."""
    time_s = np.arange(0, 6, STEP_S)
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=0.02, kinetic_n_mm_per_mm=0.002)
    drive_deg = 80.0 * np.sin(1.3 * time_s)
    last = {}
    for grip in (1.0, 100.0):
        drive = Drive(grip_torque_n_mm=grip, **more)
        run = turned(tissue, time_s, drive_deg, arrangement=arrangement, drive=drive)
        work, heat = run.outputs[-1, [memory_map.O_WORK, memory_map.O_DISSIPATED]]
        stored = run.outputs[-1, [memory_map.O_SHAFT_ENERGY, memory_map.O_TISSUE_ENERGY]].sum()
        assert work == pytest.approx(heat + stored, rel=2e-3)
        last[grip] = run
    if not more:
        assert abs(last[1.0].base_torque_n_mm).max() == pytest.approx(1.0, rel=1e-3)
    assert last[100.0].outputs[-1, memory_map.O_CHUCK_SLIP] == 0.0
    assert abs(last[1.0].outputs[:, memory_map.O_CHUCK_SLIP]).max() > 0.1


HARDENS_DEG = 12.0


def hardening(steepness):
    """Stiffness over the twist, times (1 + (twist / HARDENS_DEG)^2)^steepness."""
    at = contact_places(3.0, 60.0)
    factors = (1 + (at / HARDENS_DEG) ** 2) ** steepness
    return ContactCurve(over="twist", scale=3.0, last=60.0, factors=tuple(factors))


@ARRANGEMENTS
@pytest.mark.parametrize("sign", [1, -1])
def test_tissue_that_hardens_takes_the_torque_of_its_twist(arrangement, sign):
    """Friction so high that nothing slips: at rest the tissue is twisted by the angle of the base."""
    curve_of, stiffness = hardening(1.0), 0.01
    time_s = np.arange(0, 12, STEP_S)
    drive_deg = sign * np.minimum(6.0 * time_s, 30.0)
    tissue = Tissue.uniform(
        viscous_n_mm_s_per_mm=1e6,
        stiffness_n_mm_per_rad_per_mm=stiffness,
        time_constant_s=0.2,
        contact=curve_of,
    )
    run = turned(tissue, time_s, drive_deg, arrangement=arrangement)
    exact = sign * stiffness * factor(curve_of, 30.0) * np.radians(30.0) * LENGTH_MM
    assert run.base_torque_n_mm[-1] == pytest.approx(exact, rel=1e-4)


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


def softening():
    """Stiffness over the largest twist so far: a third of itself from 30 deg on."""
    at = contact_places(3.0, 60.0)
    factors = 1 / 3 + (2 / 3) * np.clip(1 - at / 30.0, 0.0, 1.0)
    return ContactCurve(over="strained", scale=3.0, last=60.0, factors=tuple(factors))


@ARRANGEMENTS
@pytest.mark.parametrize("sign", [1, -1])
def test_tissue_that_was_strained_is_softer_for_good(arrangement, sign):
    """Friction so high that nothing slips: held at 10 deg before and after a twist of 40 deg."""
    tissue = Tissue.uniform(
        viscous_n_mm_s_per_mm=1e6,
        stiffness_n_mm_per_rad_per_mm=0.01,
        time_constant_s=0.2,
        contact=softening(),
    )
    time_s = np.arange(0, 24, STEP_S)
    drive_deg = sign * np.interp(time_s, [0, 2, 6, 8, 12, 18, 24], [0, 10, 10, 40, 40, 10, 10])
    run = turned(tissue, time_s, drive_deg, arrangement=arrangement)
    held = {at: run.base_torque_n_mm[np.searchsorted(run.time_s, at)] for at in (5.9, 11.9, 23.9)}
    twist = {5.9: (10.0, 10.0), 11.9: (40.0, 40.0), 23.9: (10.0, 40.0)}
    for at, (now_deg, most_deg) in twist.items():
        exact = sign * 0.01 * factor(softening(), most_deg) * np.radians(now_deg) * LENGTH_MM
        assert held[at] == pytest.approx(exact, rel=1e-4)


def test_what_softening_tissue_loses_becomes_heat():
    """Work = heat + what is stored: tissue that softens while it is twisted gives less back."""
    time_s = np.arange(0, 5, STEP_S)
    tissue = Tissue.uniform(
        viscous_n_mm_s_per_mm=0.5,
        stiffness_n_mm_per_rad_per_mm=0.02,
        time_constant_s=0.05,
        contact=softening(),
    )
    run = turned(tissue, time_s, 40.0 * np.sin(0.8 * time_s))
    work, heat = run.outputs[-1, [memory_map.O_WORK, memory_map.O_DISSIPATED]]
    stored = run.outputs[-1, [memory_map.O_SHAFT_ENERGY, memory_map.O_TISSUE_ENERGY]].sum()
    # The factor is that at the start of a stage: late by 0.3 deg of 40.
    assert work == pytest.approx(heat + stored, rel=5e-3)


@pytest.mark.parametrize("steepness", [1.0, -0.4])
def test_what_hardening_tissue_stores_it_gives_back(steepness):
    """Work = heat + energy of tissue and shaft, while it is twisted, whether it hardens or softens."""
    time_s = np.arange(0, 5, STEP_S)
    tissue = Tissue.uniform(
        viscous_n_mm_s_per_mm=0.5,
        stiffness_n_mm_per_rad_per_mm=0.02,
        time_constant_s=0.05,
        contact=hardening(steepness),
    )
    run = turned(tissue, time_s, 40.0 * np.sin(0.8 * time_s))
    at = np.argmax(run.outputs[:, memory_map.O_TISSUE_ENERGY])
    work, heat = run.outputs[at, [memory_map.O_WORK, memory_map.O_DISSIPATED]]
    stored = run.outputs[at, [memory_map.O_SHAFT_ENERGY, memory_map.O_TISSUE_ENERGY]]
    assert stored[1] > 0.2 * work
    assert work == pytest.approx(heat + stored.sum(), rel=1e-3)
