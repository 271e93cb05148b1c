"""A drag at the tip: poles against a matrix of cells, the response against integration."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

from models.drive import DriveKind
from models.errors import InvalidValue
from models.modes import InsertedNeedle, ramp
from models.needle import NITINOL
from models.tip_drag_modes import TipDragNeedle

BETA, LENGTH = 0.01725, 100.0


def needle(drag, free=0.0, drive=DriveKind.ANGLE):
    shaft = InsertedNeedle(
        needle=NITINOL, damping_n_mm_s_per_mm=BETA, inserted_mm=LENGTH, free_mm=free, drive=drive
    )
    return TipDragNeedle(shaft=shaft, tip_drag_n_mm_s_per_rad=drag)


def nodes(count, drag, free, drive):
    """Stiffness and damping of `count` elements between nodes, and the spring to the base.

    A given angle without free length holds the first node, which is then left out.
    """
    a = LENGTH / count
    spring, size = NITINOL.rigidity_n_mm2 / a, count + 1
    stiffness = 2 * np.eye(size) - np.eye(size, k=1) - np.eye(size, k=-1)
    stiffness[0, 0] = stiffness[-1, -1] = 1.0
    stiffness *= spring
    damping = BETA * a * np.eye(size)
    damping[0, 0] = damping[-1, -1] = 0.5 * BETA * a
    damping[-1, -1] += drag
    if drive is DriveKind.TORQUE:
        return stiffness, damping, 0.0
    if free == 0:
        return stiffness[1:, 1:], damping[1:, 1:], spring
    entry = NITINOL.rigidity_n_mm2 / free
    stiffness[0, 0] += entry
    return stiffness, damping, entry


@pytest.mark.parametrize("drag", [0.05, 0.5, 10.0])
@pytest.mark.parametrize("drive", list(DriveKind))
@pytest.mark.parametrize("free", [0.0, 50.0])
def test_poles_are_the_eigenvalues_of_many_elements(drag, drive, free):
    stiffness, damping, _ = nodes(400, drag, free, drive)
    rates = eigh(stiffness, damping, eigvals_only=True, subset_by_index=[0, 4])
    # elements: second order, (w a)^2 / 12 of the pole with w a = 5 pi / 400
    assert needle(drag, free, drive).poles_rad_s(5) == pytest.approx(-rates, rel=2e-4, abs=1e-9)


@pytest.mark.parametrize("drive", list(DriveKind))
@pytest.mark.parametrize("free", [0.0, 50.0])
def test_without_drag_poles_and_shares_are_those_of_the_bare_tip(drive, free):
    bare = needle(0.0, free, drive)
    assert bare.poles_rad_s(6) == pytest.approx(bare.shaft.poles_rad_s(6), rel=1e-12, abs=1e-15)
    assert bare.participation(6) == pytest.approx(bare.shaft.participation(6), rel=1e-12)


def test_a_tip_that_hardly_turns_leaves_one_slow_pole_and_those_of_a_needle_held_at_both_ends():
    slow, *held = needle(1e7).poles_rad_s(4)
    # The shaft as a spring, kappa / l, against the drag; relative to it the shaft's damping is l / d.
    assert slow == pytest.approx(-NITINOL.rigidity_n_mm2 / LENGTH / 1e7, rel=1e-6)
    both_ends = -NITINOL.rigidity_n_mm2 / BETA * (np.arange(1, 4) * np.pi / LENGTH) ** 2
    assert held == pytest.approx(both_ends, rel=1e-6)


@pytest.mark.parametrize("drag", [0.02, 0.5, 1e4])
def test_the_roots_are_separate_and_none_is_left_out(drag):
    """One in every interval of pi, as the phase says."""
    wl = needle(drag, 50.0).wavenumbers_per_mm(40) * LENGTH
    k = np.arange(40)
    assert np.all((wl > (k - 0.5) * np.pi) & (wl < (k + 0.5) * np.pi))
    assert np.all(np.diff(wl) > 0)


@pytest.mark.parametrize("free", [0.0, 50.0])
def test_the_response_agrees_with_the_integration_of_many_elements(free):
    drag, count = 0.5, 120
    stiffness, damping, entry = nodes(count, drag, free, DriveKind.ANGLE)
    rate = 1.5 / 0.3
    inverse = np.diag(1 / np.diag(damping))
    pull = np.zeros(len(damping))
    pull[0] = entry / damping[0, 0]
    found, state = [], np.zeros(len(damping))
    for at, start, speed in ((np.linspace(0, 0.3, 7), 0.0, rate), (np.linspace(0.3, 1.2, 19), 1.5, 0.0)):
        there = solve_ivp(
            lambda t, y, t0=at[0], u0=start, v=speed: (
                -inverse @ stiffness @ y + pull * (u0 + v * (t - t0))
            ),
            at[[0, -1]],
            state,
            method="Radau",
            t_eval=at,
            rtol=1e-7,
            atol=1e-9,
            jac=-inverse @ stiffness,
        )
        state = there.y[:, -1]
        found.append(there.y[:, 1:])
    found = np.hstack([np.zeros((len(damping), 1)), *found])
    time = np.concatenate([np.linspace(0, 0.3, 7), np.linspace(0.3, 1.2, 19)[1:]])
    base = ramp(time, by=1.5, duration_s=0.3)
    exact = needle(drag, free).respond(time, base, count=200)
    # elements: second order, (a / l)^2 = 7e-5 of the turn
    assert np.abs(exact.tip_rad - found[-1]).max() < 2e-4
    if free:  # without a free length the series of the torque converges too slowly to compare
        torque = entry * (base - found[0])
        assert np.abs(exact.base_torque_n_mm - torque).max() < 2e-3 * torque.max()


def test_a_turn_at_a_constant_rate_lags_by_shaft_and_tip():
    """tau(x) falls from (beta l + c) omega to c omega: the lag is its integral over kappa."""
    time, rate, drag, free = np.array([0.0, 60.0]), 0.08, 0.5, 50.0
    response = needle(drag, free).respond(time, rate * time, count=2000)
    shaft = BETA * rate * LENGTH * (free + LENGTH / 2)
    tip = drag * rate * (free + LENGTH)
    lag = (shaft + tip) / NITINOL.rigidity_n_mm2
    # Terms beyond 2000 modes fall as 1 / k^4 or faster.
    assert rate * 60 - response.tip_rad[-1] == pytest.approx(lag, rel=1e-6)


@pytest.mark.parametrize("drag", [-0.1, np.nan])
def test_an_impossible_drag_is_refused(drag):
    with pytest.raises(InvalidValue, match="tip_drag_n_mm_s_per_rad"):
        needle(drag)


def test_a_response_to_an_angle_needs_a_needle_driven_by_angle():
    with pytest.raises(InvalidValue, match="drive"):
        needle(0.1, drive=DriveKind.TORQUE).respond([0.0, 1.0], [0.0, 1.0])
