"""Modes and responses of the continuous needle against integration and a matrix exponential."""

import control
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from models.drive import DriveKind
from models.errors import InvalidValue
from models.modes import InsertedNeedle, ramp
from models.needle import NITINOL

BETA = 0.01725


def held(length=200.0, free=0.0, drive=DriveKind.ANGLE):
    return InsertedNeedle(
        needle=NITINOL, damping_n_mm_s_per_mm=BETA, inserted_mm=length, free_mm=free, drive=drive
    )


def test_poles_of_a_torque_driven_needle_go_as_the_squares():
    poles = held(drive=DriveKind.TORQUE).poles_rad_s(5)
    assert poles[1:] / poles[1] == pytest.approx([1, 4, 9, 16])
    # paper-stated constants: -pi^2 kappa / (l b)
    assert poles[1] == pytest.approx(-(np.pi**2) * 323.5764 / (200 * 3.45), rel=1e-6)


@pytest.mark.parametrize("free", [5.0, 50.0, 300.0])
def test_wavenumbers_with_a_free_length_solve_the_boundary_condition(free):
    needle = held(free=free)
    wl = needle.wavenumbers_per_mm(6) * needle.inserted_mm
    assert wl * np.tan(wl) == pytest.approx(np.full(6, needle.inserted_mm / free), rel=1e-9)
    assert np.all(np.diff(wl) > 0)
    assert wl[0] < np.pi / 2


def test_a_vanishing_free_length_is_no_free_length():
    assert held(free=1e-6).poles_rad_s(4) == pytest.approx(held().poles_rad_s(4), rel=1e-7)


@pytest.mark.parametrize("drive", list(DriveKind))
@pytest.mark.parametrize("free", [0.0, 50.0])
def test_poles_with_inertia_are_roots_of_the_wave_equation(drive, free):
    """Integrated from the free tip to the base, the shape meets the base's condition."""
    needle = held(free=free, drive=drive)
    pole = needle.poles_with_inertia_rad_s(3)[2]
    eta, kappa = NITINOL.rotary_inertia_kg_m, NITINOL.rigidity_n_mm2
    shape = np.array([1.0, 0.0])  # theta and theta' at the tip
    for length, damping in ((200.0, BETA), (free, 0.0)):
        stiff = (eta * pole**2 + damping * pole) / kappa
        there = solve_ivp(
            lambda _, y, k=stiff: [y[1], k * y[0]], (0, length), shape, rtol=1e-11, atol=1e-13
        )
        shape = there.y[:, -1]
    residual = shape[0] if drive is DriveKind.ANGLE else shape[1] * 200
    assert abs(residual) < 1e-7


def test_inertia_moves_the_slow_poles_by_less_than_the_paper_says():
    needle = held(drive=DriveKind.TORQUE)
    change = needle.poles_with_inertia_rad_s(5)[1:] / needle.poles_rad_s(5)[1:] - 1
    assert np.all(np.abs(change) < 1e-5)  # "within 0.001 %", Section III-E
    fast = needle.overtones_rad_s(3).real
    assert fast == pytest.approx(np.full(3, -BETA / NITINOL.rotary_inertia_kg_m), rel=1e-6)


def test_the_modes_represent_a_uniform_turn():
    needle = held(free=50.0)
    a, w = needle.participation(4000), needle.wavenumbers_per_mm(4000)
    x = np.linspace(20, 200, 7)
    # the series of a function that misses the boundary condition converges as 1/k^2 inside
    assert np.cos(np.outer(200 - x, w)) @ a == pytest.approx(np.ones(7), abs=1e-3)


@pytest.mark.parametrize("free", [0.0, 50.0])
def test_the_ramp_response_agrees_with_the_lumped_needle(free):
    """An independent matrix exponential of 400 cells, by python-control."""
    cells, length = 400, 200.0
    a = length / cells
    spring, entry = NITINOL.rigidity_n_mm2 / a, NITINOL.rigidity_n_mm2 / (free + a / 2)
    stiffness = 2 * np.eye(cells) - np.eye(cells, k=1) - np.eye(cells, k=-1)
    stiffness *= spring
    stiffness[0, 0], stiffness[-1, -1] = spring + entry, spring
    drag = BETA * a
    b = np.zeros((cells, 1))
    b[0] = entry / drag
    c = np.eye(cells)[[-1, 0]]
    system = control.ss(-stiffness / drag, b, c, 0)
    time = np.linspace(0, 2, 401)
    base = ramp(time, by=np.pi / 2, duration_s=0.3)
    tip, first = control.forced_response(system, time, base).outputs
    exact = held(free=free).respond(time, base, count=300)
    # cells: second order, (a / l)^2 = 6e-6 of the turn
    assert np.abs(exact.tip_rad - tip).max() < 2e-5
    if free:  # without a free length the series of the torque converges too slowly to compare
        torque = entry * (base - first)
        assert np.abs(exact.base_torque_n_mm - torque).max() < 5e-3 * torque.max()


@pytest.mark.parametrize(
    ("field", "value"), [("damping_n_mm_s_per_mm", 0.0), ("inserted_mm", -1.0), ("free_mm", np.nan)]
)
def test_an_impossible_needle_is_refused(field, value):
    good = {"damping_n_mm_s_per_mm": BETA, "inserted_mm": 100.0, "free_mm": 0.0}
    with pytest.raises(InvalidValue, match=field):
        InsertedNeedle(needle=NITINOL, **(good | {field: value}))


def test_times_that_do_not_increase_are_refused():
    with pytest.raises(InvalidValue, match="time_s"):
        held().respond([0.0, 0.0], [0.0, 1.0])
