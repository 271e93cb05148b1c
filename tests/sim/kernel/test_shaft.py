"""What the kernel reads of the needle from MuJoCo's model."""

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from models.drive import Drive, DriveKind
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation
from sim.needles.setup import Setup

VISCOUS = Tissue.uniform(viscous_n_mm_s_per_mm=0.01725)


def setup(arrangement=Arrangement.CHAIN, **drive):
    return Setup(
        needle=NITINOL,
        tissue=VISCOUS,
        drive=Drive(**drive),
        discretisation=Discretisation(elements=4, arrangement=arrangement),
        free_mm=50,
        inserted_mm=150,
    )


@pytest.mark.parametrize("arrangement", Arrangement)
def test_springs_and_inertia_are_those_of_the_needle(shaft_of, arrangement):
    shaft = shaft_of(setup(arrangement))
    # 50 mm free as one element, then four of 37.5 mm; kappa = J G
    assert shaft.spring == pytest.approx(323.576e-6 / np.array([0.05, *[0.0375] * 4]), rel=1e-5)
    assert shaft.inertia.sum() == pytest.approx(NITINOL.rotary_inertia_kg_m * 0.2)


def test_inertia_about_the_axis_follows_the_frame_of_the_body(interpreted):
    """Principal moments in a frame that is turned: (R diag(I) R')_xx."""
    moments, turned = np.array([1.0, 2.0, 3.0]), Rotation.from_rotvec([0.3, -0.5, 0.7])
    matrix = turned.as_matrix() @ np.diag(moments) @ turned.as_matrix().T
    x, y, z, w = turned.as_quat()
    axial = interpreted.shaft.axial_inertia(moments, np.array([w, x, y, z]))
    assert axial == pytest.approx(matrix[0, 0], rel=1e-14)


def test_mujoco_itself_feels_the_same_inertia_of_a_turned_body(interpreted):
    spec = mujoco.MjSpec()
    body = spec.worldbody.add_body(
        mass=1, inertia=[0.01, 0.02, 0.025], ipos=[0, 0, 0], explicitinertial=True
    )
    body.iquat = [0.8, 0.36, 0.48, 0.0]
    body.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE, axis=[1, 0, 0])
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    mass = np.zeros((1, 1))
    mujoco.mj_fullM(model, data, mass)
    axial = interpreted.shaft.axial_inertia(model.body_inertia[1], model.body_iquat[1])
    assert axial == pytest.approx(mass[0, 0], rel=1e-12)


@pytest.mark.parametrize(("ctrl", "torque"), [(0.2e-3, 0.2e-3), (2e-3, 0.5e-3), (-2e-3, -0.5e-3)])
def test_a_motor_gives_no_more_torque_than_its_limit(interpreted, shaft_of, ctrl, torque):
    shaft = shaft_of(setup(kind=DriveKind.TORQUE, torque_limit_n_mm=0.5))
    assert shaft.servo == 0.0
    assert interpreted.shaft.drive_input(shaft, ctrl) == pytest.approx(torque)


def test_a_servo_rests_where_its_motor_balances_its_spring(interpreted, shaft_of):
    shaft = shaft_of(setup(stiffness_n_mm_per_rad=5.0))
    assert shaft.servo == pytest.approx(5e-3)
    assert interpreted.shaft.drive_input(shaft, 0.3) == pytest.approx(0.3)
    weak = shaft._replace(motor=shaft.motor._replace(gain=0.5))
    assert interpreted.shaft.drive_input(weak, 0.3) == pytest.approx(0.15)


def test_a_rotor_adds_its_inertia_to_the_first_node_alone(shaft_of):
    bare, geared = shaft_of(setup()), shaft_of(setup(rotor_inertia_kg_m2=1e-7))
    added = geared.inertia - bare.inertia
    assert added == pytest.approx([1e-7, 0, 0, 0, 0, 0])
