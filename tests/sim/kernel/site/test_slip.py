"""Friction at the surface of the shaft against the equations of its docstring, in the interpreter."""

import math

import pytest

G, YIELD = 1e-3, 1e-3  # length of the stage, s, and presliding angle, rad


@pytest.fixture
def slip(interpreted):
    return interpreted.slip


def memory(slip, dry=0.0, past=0.0):
    return slip.Memory(dry, 0.0, 0.0, 0.0, past)


def slip_torque(slip, row, s, old=None, axial=0.0):
    return slip.slip_law(s, row, 0.0, old or memory(slip), slip.Stage(G, axial, YIELD))


@pytest.mark.parametrize("exponent", [0.5, 1.0, 1.4])
def test_the_power_law_grows_with_its_exponent(slip, row, exponent):
    fields = row(viscous=0.02, exponent=exponent)
    one, two = (slip_torque(slip, fields, s)[0] for s in (1.0, 2.0))
    assert one == pytest.approx(0.02)
    assert two / one == pytest.approx(2**exponent)


def test_a_dry_element_is_a_spring_up_to_its_level(slip, row):
    fields = row(kinetic=0.3, static=0.3)
    half = slip_torque(slip, fields, 0.5 * YIELD / G)
    full = slip_torque(slip, fields, 20 * YIELD / G)
    assert half[0] == pytest.approx(0.15)
    assert full[0] == pytest.approx(0.3)
    assert full[2].dry == pytest.approx(YIELD)
    assert (half[1], full[1]) == pytest.approx((0.3 * G / YIELD, 0.0))


@pytest.mark.parametrize("s", [0.02, 0.1, 0.3])
def test_sliding_friction_falls_from_static_to_kinetic_as_stribeck_says(slip, row, s):
    fields = row(kinetic=0.1, static=0.3, stribeck=0.1)
    slipped = memory(slip, dry=YIELD)
    torque = slip_torque(slip, fields, s, slipped)[0]
    assert torque == pytest.approx(0.1 + 0.2 * math.exp(-((s / 0.1) ** 2)))


def test_friction_shared_with_axial_sliding_points_along_the_slip(slip, row):
    fields, turn, axial = row(shared=0.2), 0.3, 0.4
    old = memory(slip)
    for _ in range(50):  # each stage turns the presliding further towards the slip
        torque, _, old = slip_torque(slip, fields, turn, old, axial)
    assert torque == pytest.approx(0.2 * turn / math.hypot(turn, axial), rel=1e-6)
    assert math.hypot(old.turn, old.axial) == pytest.approx(YIELD)


def test_torque_that_varies_and_differs_by_direction_is_multiplied(slip, row):
    fields = row(viscous=0.02, kinetic=0.1, static=0.1, shaped=1.0, asymmetry=0.3, varies=1.0)
    old = memory(slip, dry=YIELD)
    stage = slip.Stage(G, 0.0, YIELD, 1.5)
    there, back = (slip.slip_law(s, fields, 0.0, old, stage)[0] for s in (2.0, -5.0))
    assert there == pytest.approx(1.5 * 1.3 * 0.14)
    assert back == pytest.approx(-1.5 * 0.7 * 0.2)
    plain = row(viscous=0.02, kinetic=0.1, static=0.1)
    assert slip.slip_law(2.0, plain, 0.0, old, stage)[0] == pytest.approx(0.14)


def test_what_a_contact_has_been_through_grows_with_the_slip_without_its_presliding(slip, row):
    """The slip so far: a dry contact that sticks has not slipped."""
    fields = row(kinetic=0.1, static=0.1, shaped=1.0, contact=1.0, contact_scale=0.1, contact_step=0.5)
    stuck = slip_torque(slip, fields, 0.5 * YIELD / G)[2]
    assert stuck.past == pytest.approx(0.0, abs=1e-15)
    slid = slip_torque(slip, fields, 3.0 * YIELD / G)[2]
    assert slid.past == pytest.approx(2.0 * YIELD)
