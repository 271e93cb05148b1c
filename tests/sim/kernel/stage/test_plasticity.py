"""Return mapping of an element that yields, in the interpreter."""

import numpy as np
import pytest

from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Discretisation
from sim.needles.setup import Setup

STIFFNESS, YIELD, SLOPE = 2.0, 0.5, 0.25
HARDENING = STIFFNESS * SLOPE / (1 - SLOPE)


@pytest.fixture
def frame(interpreted):
    whole = interpreted.workspace.Frame(1e-3, 0.0, 0.0, 1e-3, 0.0, 0.0)
    return whole._replace(yield_torque=YIELD, yield_slope=SLOPE)


@pytest.mark.parametrize("before", [0.0, 0.1, -0.2])
@pytest.mark.parametrize("twist", [-1.0, -0.2, 0.0, 0.24, 0.8])
def test_torque_less_back_stress_never_exceeds_the_yield_torque(interpreted, frame, before, twist):
    after = interpreted.plasticity.set_after(STIFFNESS, frame, twist, before)
    beyond = STIFFNESS * (twist - after) - HARDENING * after
    assert abs(beyond) <= YIELD * (1 + 1e-12)
    if after != before:  # it yields: on the limit, and in the direction of the torque
        assert abs(beyond) == pytest.approx(YIELD)
        assert np.sign(after - before) == np.sign(beyond)


def test_beyond_yielding_the_slope_is_its_share_of_the_stiffness(interpreted, frame):
    torques = [
        STIFFNESS * (twist - interpreted.plasticity.set_after(STIFFNESS, frame, twist, 0.0))
        for twist in (0.2, 0.21, 0.6, 0.61)
    ]
    assert np.diff(torques)[[0, 2]] / 0.01 == pytest.approx([STIFFNESS, SLOPE * STIFFNESS])


def test_the_slopes_of_the_residual_are_its_derivatives(interpreted, at_stage):
    """What sets add to the matrix is minus what they add to the residual, over the rates."""
    needle = NITINOL.but(yield_torque_n_mm=0.01, yield_stiffness_ratio=0.3)
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=0.02)
    stage = at_stage(
        Setup(
            needle=needle,
            tissue=tissue,
            free_mm=20.0,
            inserted_mm=60.0,
            discretisation=Discretisation(elements=4),
        )
    )
    w = stage.w
    frame = stage.frame._replace(yield_torque=1e-5, yield_slope=0.3)
    w.set_before[:] = 0.0

    def added(rates):
        w.omega[:] = rates
        for array in (w.rhs, w.lower, w.diagonal, w.upper):
            array[:] = 0.0
        interpreted.plasticity.add_sets(w, frame)
        return w.rhs.copy()

    rates = w.omega.copy()
    at_rates = added(rates)
    assert (w.set != 0.0).all()  # all elements yield
    matrix = np.diag(w.diagonal) + np.diag(w.upper[:-1], 1) + np.diag(w.lower[1:], -1)
    step = 1e-3
    for i in range(rates.size):
        moved = added(rates + step * np.eye(rates.size)[i])
        np.testing.assert_allclose((moved - at_rates) / step, -matrix[:, i], atol=1e-9)


def test_sets_are_carried_kept_and_become_heat(interpreted, frame):
    plasticity, n = interpreted.plasticity, 3
    memory = np.zeros(interpreted.memory_map.scratch(n, 1))
    w = interpreted.workspace.divide(memory, n, 1, np.zeros((1, n, 2, interpreted.memory_map.SITE)))
    w.spring[:n] = STIFFNESS
    sets, after = np.array([0.0, 0.1, -0.2]), np.zeros(n)
    plasticity.hold_sets(w, sets)
    np.testing.assert_array_equal(w.set, sets)
    w.set[:] = sets + 0.1
    plasticity.carry_sets(w, sets, 0.0, 2.0)
    np.testing.assert_allclose(w.set_before, sets + 0.2)
    heat, stored = plasticity.keep_sets(w, frame, 0.01, sets, after)
    np.testing.assert_allclose(after, sets + 0.1)
    assert heat == pytest.approx(n * YIELD * 0.1)
    assert stored == pytest.approx(0.5 * HARDENING * np.sum(after**2))


CREEP, CREEP_S = 0.4, 2.0


@pytest.fixture
def creeping(frame):
    return frame._replace(yield_torque=0.0, creep=CREEP, creep_time=CREEP_S)


def test_the_set_of_an_element_that_creeps_is_of_its_twist_with_that_slope(interpreted, creeping):
    crept = interpreted.plasticity.crept_after
    (low, slope), (high, _) = (crept(creeping, twist, 0.02) for twist in (0.1, 0.2))
    assert (high - low) / 0.1 == pytest.approx(slope)
    # Implicit: (set - before) / g = (c (twist - set) - set) / tau.
    rate = (CREEP * (0.1 - low) - low) / CREEP_S
    assert (low - 0.02) / creeping.g == pytest.approx(rate)


def test_what_creep_takes_is_stored_and_becomes_heat(interpreted, creeping):
    """Of a twist that is held: elastic energy at first, less at last, and the rest is heat."""
    plasticity, n, step_s = interpreted.plasticity, 1, 0.01
    memory = np.zeros(interpreted.memory_map.scratch(n, 1))
    w = interpreted.workspace.divide(memory, n, 1, np.zeros((1, n, 2, interpreted.memory_map.SITE)))
    w.spring[:n] = STIFFNESS
    frame, twist, heat, stored = creeping._replace(g=step_s), 0.1, 0.0, 0.0
    sets, after = np.zeros(n), np.zeros(n)
    for _ in range(2000):
        w.set[0], _ = plasticity.crept_after(frame, twist, sets[0])
        more, stored = plasticity.keep_sets(w, frame, step_s, sets, after)
        heat, sets[:] = heat + more, after
    assert sets[0] == pytest.approx(twist * CREEP / (1.0 + CREEP), rel=1e-4)
    first, last = 0.5 * STIFFNESS * twist**2, 0.5 * STIFFNESS * (twist - sets[0]) ** 2 + stored
    assert first - last == pytest.approx(heat, rel=step_s / CREEP_S)


@pytest.mark.parametrize("at", [2.0, 2.3, 3.9])
def test_the_play_of_a_joint_is_shared_by_the_elements_beside_it(interpreted, frame, at):
    jointed = frame._replace(joint=0.1, joint_at=at)
    plays = [interpreted.plasticity.play_of(jointed, e) for e in range(8)]
    assert sum(plays) == pytest.approx(0.1)
    assert sum(e * play for e, play in enumerate(plays)) == pytest.approx(0.1 * at)
    assert sum(play > 0 for play in plays) <= 2
