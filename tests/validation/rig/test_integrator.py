"""The integrator: coefficients of BDF2, rest, determinism, and the balance of the whole needle."""

import numpy as np
import pytest

from validation.rig.integrator import _weights, integrate
from validation.rig.mesh import MeshSize
from validation.rig.rig import IndependentRig


def inputs(motion):
    drive = np.zeros((5, motion.base_deg.size))
    drive[0], drive[1], drive[2] = np.radians(motion.base_deg), motion.inserted_mm, motion.free_mm
    drive[3] = motion.speed_mm_s
    return drive


@pytest.mark.parametrize(("step", "last"), [(0.1, 0.1), (0.05, 0.1), (0.2, 0.1)])
def test_bdf2_differentiates_a_parabola_exactly(step, last):
    lead, now, older = _weights(step, last)
    t = 1.3
    rate = lead * t**2 - now * (t - step) ** 2 + older * (t - step - last) ** 2
    assert rate == pytest.approx(2 * t, rel=1e-12)


@pytest.mark.parametrize(("step", "last"), [(0.1, 0.0), (0.3, 0.1)])
def test_a_first_or_a_much_longer_step_is_backward_euler(step, last):
    assert _weights(step, last) == (1 / step, 1 / step, 0.0)


@pytest.mark.parametrize("mesh", [MeshSize(20, 0, False), MeshSize(21, 0, True)])
def test_what_is_at_rest_stays_at_rest(drive, make_rig, mesh):
    still = drive(lambda time_s: np.zeros_like(time_s), end=0.5)
    tip, torque, lost = integrate(make_rig().law(), mesh, still.dt_s, inputs(still))
    assert (lost, np.abs(tip).max(), np.abs(torque).max()) == (-1, 0.0, 0.0)


def test_the_same_trial_gives_the_same_bits(drive, make_rig):
    law, mesh, motion = (
        make_rig(coulomb_friction={"level": 0.003}).law(),
        MeshSize(20, 0, False),
        drive(),
    )
    one, other = (integrate(law, mesh, motion.dt_s, inputs(motion)) for _ in range(2))
    assert all((a == b).all() for a, b in zip(one[:2], other[:2], strict=True))


def test_without_friction_the_tip_follows_the_base_and_no_torque_is_needed(drive):
    """Tolerance: Newton's 1e-7 rad at the tip, and that times the stiffness of a link."""
    law = IndependentRig(damping_n_mm_s_per_mm=0.0).law()
    motion = drive()
    tip, torque, _ = integrate(law, MeshSize(20, 0, False), motion.dt_s, inputs(motion))
    assert tip == pytest.approx(np.radians(motion.base_deg), abs=1e-7)
    assert np.abs(torque).max() < 1e-7 * law.rigidity / 2.0


def test_a_trial_that_has_no_balance_names_the_sample(drive, make_rig):
    motion = drive(end=0.1)
    lost_at = inputs(motion)
    lost_at[0, 7:] = np.nan
    assert integrate(make_rig().law(), MeshSize(20, 0, False), motion.dt_s, lost_at)[2] == 7
