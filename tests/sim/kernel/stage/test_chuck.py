"""The torque of the drive on the first node: servo, motor, play, and a coupling that turns in itself.

`sim.kernel.stage.chuck` in the interpreter: the same source, nothing to compile.
"""

import numpy as np
import pytest

from models.drive import Drive, DriveKind
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Discretisation
from sim.needles.setup import Setup

VISCOUS = Tissue.uniform(viscous_n_mm_s_per_mm=0.02)
SOFT_N_MM_PER_RAD = 0.5
COUPLINGS = {
    "slips": Drive(grip_torque_n_mm=0.4),
    "unwinds, and slips": Drive(stiffness_n_mm_per_rad=40.0, unwinding_ratio=0.3, grip_torque_n_mm=0.4),
    "play that rubs": Drive(grip_torque_n_mm=0.4, grip_play_deg=20),
    "spring that rubs": Drive(grip_torque_n_mm=0.4, grip_stiffness_n_mm_per_rad=SOFT_N_MM_PER_RAD),
    "soft, then stiff": Drive(
        grip_torque_n_mm=1e-3, grip_stiffness_n_mm_per_rad=SOFT_N_MM_PER_RAD, grip_play_deg=20
    ),
}


def setup(drive):
    cut = Discretisation(elements=5, step_s=0.001)
    return Setup(
        needle=NITINOL, tissue=VISCOUS, drive=drive, discretisation=cut, free_mm=20, inserted_mm=40
    )


@pytest.mark.parametrize("kind", DriveKind)
def test_a_drive_gives_its_torque_or_that_of_its_servo(interpreted, at_stage, kind):
    stage = at_stage(setup(Drive(kind=kind)))
    torque, slope = interpreted.chuck.drive_torque(stage.w, stage.frame, 0.3)
    if kind is DriveKind.TORQUE:
        assert (torque, slope) == (0.3, 0.0)
    else:
        reached = stage.w.theta[0] + stage.frame.g * stage.w.omega[0]
        assert torque == pytest.approx(stage.frame.servo * (0.3 - reached))
        assert slope == pytest.approx(stage.frame.servo * stage.frame.g)


def test_inside_its_play_the_chuck_gives_nothing(interpreted, at_stage):
    stage = at_stage(setup(Drive(backlash_deg=30)))
    reached = stage.w.theta[0] + stage.frame.g * stage.w.omega[0]
    inside, beyond = reached + np.radians(14.9), reached + np.radians(15.1)
    assert interpreted.chuck.drive_torque(stage.w, stage.frame, inside) == (0.0, 0.0)
    torque, _ = interpreted.chuck.drive_torque(stage.w, stage.frame, beyond)
    assert torque == pytest.approx(stage.frame.servo * np.radians(0.1))


@pytest.mark.parametrize(("miss_rad", "ratio"), [(0.2, 1.0), (-0.2, 0.25)])
def test_a_helical_spring_is_softer_as_it_unwinds(interpreted, at_stage, miss_rad, ratio):
    """40 N mm / rad where the drive is ahead, 10 where the needle is; the rest is taken up unfelt."""
    stage = at_stage(setup(Drive(stiffness_n_mm_per_rad=40.0, unwinding_ratio=0.25)))
    drive_rad = stage.w.theta[0] + stage.frame.g * stage.w.omega[0] + miss_rad
    torque, slope = interpreted.chuck.drive_torque(stage.w, stage.frame, drive_rad)
    assert torque == pytest.approx(ratio * 0.04 * miss_rad)
    assert slope == pytest.approx(ratio * 0.04 * stage.frame.g)
    unfelt = interpreted.chuck.taken_up(miss_rad, stage.frame)
    assert 0.04 * (miss_rad - unfelt) == pytest.approx(torque)
    assert stage.nonlinear


def coupling(interpreted, at_stage, drive, miss_rad, slip_rad):
    """Torque and slip of a coupling, N mm and rad, and the stage; the servo is ahead by `miss_rad`."""
    stage = at_stage(setup(drive))
    servo_rad = stage.w.theta[0] + stage.frame.g * stage.w.omega[0] + miss_rad
    torque, _ = interpreted.chuck.drive_torque(stage.w, stage.frame, servo_rad, slip_rad)
    more_rad = interpreted.chuck.slipped(stage.w, stage.frame, servo_rad, torque, slip_rad)
    return 1e3 * torque, slip_rad + more_rad, stage


@pytest.mark.parametrize("name", COUPLINGS)
@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("slip_rad", [-0.1, 0.0, 0.17])
@pytest.mark.parametrize("miss_rad", [1e-9, 0.05, 0.3])
def test_a_coupling_turns_until_it_grips_again_or_comes_to_its_stop(
    interpreted, at_stage, name, sign, slip_rad, miss_rad
):
    """|torque - spring s| <= grip within the stops; where it has turned, one of both is met."""
    drive = COUPLINGS[name]
    torque, slip, stage = coupling(interpreted, at_stage, drive, sign * miss_rad, sign * slip_rad)
    pull = torque - drive.grip_stiffness_n_mm_per_rad * slip
    stop_rad = np.radians(drive.grip_play_deg or np.inf) / 2
    at_stop = abs(slip) > stop_rad * (1 - 1e-9)
    turned = abs(slip - sign * slip_rad) > 1e-12
    assert abs(slip) <= stop_rad * (1 + 1e-9)
    rounding = 1e-15 * 1e3 * stage.frame.servo * miss_rad
    assert at_stop or abs(pull) <= drive.grip_torque_n_mm * (1 + 1e-9) + rounding
    if turned:
        assert at_stop or abs(pull) == pytest.approx(drive.grip_torque_n_mm, rel=1e-9, abs=rounding)
        assert pull * (slip - sign * slip_rad) > 0  # the way it is pulled
    left_rad = sign * miss_rad - (slip - sign * slip_rad)
    servo = stage.frame.servo * (drive.unwinding_ratio if sign < 0 else 1.0)
    assert torque == pytest.approx(1e3 * servo * left_rad, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("name", COUPLINGS)
@pytest.mark.parametrize("miss_rad", [1e-8, 0.1, 0.5])
def test_the_slope_is_the_derivative_of_the_torque(interpreted, at_stage, name, miss_rad):
    stage = at_stage(setup(COUPLINGS[name]))
    servo_rad = stage.w.theta[0] + stage.frame.g * stage.w.omega[0] + miss_rad
    torque, slope = interpreted.chuck.drive_torque(stage.w, stage.frame, servo_rad)
    stage.w.omega[0] -= 1e-6
    moved, _ = interpreted.chuck.drive_torque(stage.w, stage.frame, servo_rad)
    assert (moved - torque) / 1e-6 == pytest.approx(slope, rel=1e-4, abs=1e-9 * stage.frame.servo)
