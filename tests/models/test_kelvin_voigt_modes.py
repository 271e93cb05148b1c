"""Yielding tissue: poles against a matrix of cells, the response against integration."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from models.drive import DriveKind
from models.errors import InvalidValue
from models.kelvin_voigt_modes import YieldingTissueNeedle
from models.modes import InsertedNeedle, ramp
from models.needle import NITINOL

BETA, STIFFNESS, TAU = 0.01725, 5.16e-3, 1.04


def needle(free=0.0, drive=DriveKind.ANGLE, stiffness=STIFFNESS, tau=TAU, length=200.0):
    viscous = InsertedNeedle(
        needle=NITINOL, damping_n_mm_s_per_mm=BETA, inserted_mm=length, free_mm=free, drive=drive
    )
    return YieldingTissueNeedle(
        viscous=viscous, stiffness_n_mm_per_rad_per_mm=stiffness, time_constant_s=tau
    )


def cells(count, free, drive, length=200.0):
    """Rates of (theta, phi) of `count` cells: a matrix, and what a base angle of 1 adds."""
    a, kappa = length / count, NITINOL.rigidity_n_mm2
    stiffness = 2 * np.eye(count) - np.eye(count, k=1) - np.eye(count, k=-1)
    stiffness[0, 0] = stiffness[-1, -1] = 1.0
    stiffness *= kappa / a
    entry = kappa / (free + a / 2) if drive is DriveKind.ANGLE else 0.0
    stiffness[0, 0] += entry
    torque, pulled = -stiffness / a, np.zeros(count)  # per mm, on the interface
    pulled[0] = entry / a
    creep = np.hstack([torque / (STIFFNESS * TAU), -np.eye(count) / TAU])
    slip = np.hstack([torque / BETA, np.zeros((count, count))])
    turned = np.concatenate([pulled * (1 / BETA + 1 / (STIFFNESS * TAU)), pulled / (STIFFNESS * TAU)])
    return np.vstack([slip + creep, creep]), turned, entry


@pytest.mark.parametrize("drive", list(DriveKind))
@pytest.mark.parametrize("free", [0.0, 50.0])
def test_poles_are_the_eigenvalues_of_many_cells(drive, free):
    count = 400
    matrix, _, _ = cells(count, free, drive)
    eigenvalues = np.sort(np.linalg.eigvals(matrix).real)[::-1]
    first = 0 if drive is DriveKind.ANGLE else 1
    slow, fast = needle(free, drive).poles_rad_s(first + 4)[first:].T
    border = 0.5 * (needle().creep_limit_rad_s - 1 / TAU)
    # cells: second order, (w a)^2 / 12 of the pole, w a = 4 pi / 400; the entry's half cell likewise
    assert eigenvalues[eigenvalues < border][first : first + 4] == pytest.approx(fast, rel=3e-4)
    assert eigenvalues[eigenvalues > border][first : first + 4] == pytest.approx(slow, rel=3e-4)


def test_a_shaft_that_turns_freely_has_the_poles_of_the_tissue_alone():
    assert needle(drive=DriveKind.TORQUE).poles_rad_s(1)[0] == pytest.approx([0.0, -1 / TAU])


def test_slow_poles_gather_at_the_creep_limit_and_fast_ones_go_as_in_two_dampers_in_series():
    slow, fast = needle().poles_rad_s(400).T
    assert np.all(np.diff(slow) < 0)
    assert np.all(slow > needle().creep_limit_rad_s)
    # What is left of the distance falls as 1 / m, and m grew by 800^2.
    assert slow[-1] == pytest.approx(needle().creep_limit_rad_s, rel=1e-5)
    series = BETA * STIFFNESS * TAU / (BETA + STIFFNESS * TAU)
    m = -needle().viscous.poles_rad_s(400)[-1] * BETA
    assert fast[-1] == pytest.approx(-m / series, rel=1e-5)


def test_stiff_tissue_has_the_poles_of_tissue_that_does_not_yield():
    stiff = needle(free=50.0, stiffness=STIFFNESS * 1e8)
    viscous = stiff.viscous.poles_rad_s(3)
    # Mode k is slow where it does not reach the tissue's own -1 / tau, else fast.
    slow, fast = stiff.poles_rad_s(3).T
    found = np.where(viscous > -1 / TAU, slow, fast)
    assert found == pytest.approx(viscous, rel=1e-6)
    assert stiff.shares(3).max(axis=1) == pytest.approx(np.ones(3), abs=1e-6)


@pytest.mark.parametrize("free", [0.0, 50.0])
def test_the_shares_of_a_mode_are_positive_and_add_up_to_one(free):
    shares = needle(free).shares(50)
    assert shares.sum(axis=1) == pytest.approx(np.ones(50), abs=1e-12)
    assert shares.min() > 0


def test_the_response_agrees_with_the_integration_of_many_cells():
    count, free = 160, 50.0
    matrix, turned, entry = cells(count, free, DriveKind.ANGLE)
    time = np.linspace(0.0, 3.0, 61)

    def rate(t, state):
        return matrix @ state + turned * ramp(t, by=1.5, duration_s=0.3)

    kinks = (np.linspace(0, 0.3, 7), np.linspace(0.3, 3.0, 55))
    state, found = np.zeros(2 * count), []
    for at in kinks:  # the solver sees no corner
        there = solve_ivp(
            rate, at[[0, -1]], state, method="Radau", t_eval=at, rtol=1e-7, atol=1e-9, jac=matrix
        )
        state = there.y[:, -1]
        found.append(there.y[:, 1:])
    found = np.hstack([np.zeros((2 * count, 1)), *found])
    base = ramp(time, by=1.5, duration_s=0.3)
    exact = needle(free).respond(time, base, count=200)
    # The last cell's centre is half a cell before the tip: (w a)^2 / 8, second order.
    assert np.abs(exact.tip_rad - found[count - 1]).max() < 2e-4
    torque = entry * (base - found[0])
    assert np.abs(exact.base_torque_n_mm - torque).max() < 5e-3 * torque.max()


def test_a_turn_at_a_constant_rate_lags_as_viscous_tissue_plus_the_wound_up_tissue():
    """Long after, phi = f / k everywhere and the shaft slips at the base's rate: eq. (2), as viscous."""
    time, rate = np.array([0.0, 200.0]), 0.08
    yielding = needle(50.0).respond(time, rate * time, count=2000)
    lag = BETA * rate * 200 * (50 + 100) / NITINOL.rigidity_n_mm2
    # Terms beyond 2000 modes: sum of a_k / |p_k|, as 1 / k^3.
    assert rate * 200 - yielding.tip_rad[-1] == pytest.approx(lag, rel=1e-6)


@pytest.mark.parametrize("field", ["stiffness", "tau"])
def test_tissue_without_stiffness_or_damper_is_refused(field):
    with pytest.raises(InvalidValue, match=field if field == "stiffness" else "time_constant_s"):
        needle(**{field: 0.0})


def test_a_response_to_an_angle_needs_a_needle_driven_by_angle():
    with pytest.raises(InvalidValue, match="drive"):
        needle(drive=DriveKind.TORQUE).respond([0.0, 1.0], [0.0, 1.0])
