"""The kerf of the tip against the equations of its docstring, in the interpreter."""

import math
from types import SimpleNamespace

import pytest
from scipy.integrate import quad

G, K, KERF = 1e-3, 5.0, 20.0  # stage, s; stiffness, N m / rad; what a radius of axial motion takes
ANGLES = {"a sine": 0.0, "a spring that softens": 0.15}


@pytest.fixture(params=ANGLES.values(), ids=ANGLES)
def case(interpreted, request):
    places = interpreted.memory_map

    def row(**fields):
        values = [0.0] * places.COLUMNS
        own = {"stiffness": K, "kerf": KERF, "backwards": 1.0, "kerf_angle": request.param}
        for name, value in (own | fields).items():
            values[getattr(places, f"L_{name.upper()}")] = value
        return values

    return SimpleNamespace(kerf=interpreted.kerf, row=row, angle=request.param)


def shape(case, phi):
    return case.angle * math.tanh(phi / case.angle) if case.angle else math.sin(phi)


def after(case, omega=0.0, before=0.3, axial=0.0, **fields):
    return case.kerf.in_kerf(omega, case.row(**fields), before, G, axial)


@pytest.mark.parametrize("phi", [-0.4, 0.02, 0.2, 1.1])
def test_its_torque_has_its_shape(case, phi):
    assert after(case, before=phi).torque == pytest.approx(K * shape(case, phi))
    assert after(case, before=phi).phi == phi


@pytest.mark.parametrize("axial", [3.0, -3.0])
def test_the_angle_fades_as_the_tip_moves_on(case, axial):
    """By m times a sine, or itself, of what it is after the stage."""
    phi = after(case, axial=axial).phi
    m = G * KERF * abs(axial)
    assert phi + m * (phi if case.angle else math.sin(phi)) == pytest.approx(0.3, rel=1e-12)


def test_the_way_back_counts_in_part(case):
    back = after(case, axial=-3.0, backwards=0.4)
    assert back.phi == pytest.approx(after(case, axial=1.2).phi, rel=1e-12)
    assert after(case, axial=-3.0, backwards=0.0).phi == 0.3
    assert after(case, axial=3.0, backwards=0.0).phi == after(case, axial=3.0).phi


@pytest.mark.parametrize("omega", [-200.0, 0.5, 150.0])
def test_the_slope_is_the_derivative_of_the_torque(case, omega):
    step = 1e-2
    low, high = (after(case, omega + sign * step, axial=2.0).torque for sign in (-1, 1))
    slope = after(case, omega, axial=2.0).slope
    assert slope == pytest.approx((high - low) / (2 * step), rel=1e-5, abs=1e-9)


@pytest.mark.parametrize("phi", [-0.5, 0.1, 2.0])
def test_the_energy_is_the_work_of_the_torque(case, phi):
    work, _ = quad(lambda p: K * shape(case, p), 0.0, phi)
    assert case.kerf.kerf_energy(phi, case.row()) == pytest.approx(work, rel=1e-9)
