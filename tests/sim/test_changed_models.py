"""A model whose numbers somebody changed runs as physics says: MuJoCo's model owns the needle."""

import math

import numpy as np
import pytest

from models.drive import Drive, DriveKind
from models.modes import InsertedNeedle
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation
from sim.experiment import perform
from sim.needles.kept import compile_model
from sim.needles.run import SimulationFailed
from sim.needles.setup import Setup
from sim.paper_protocols import protocol_named
from sim.schedule import Schedule
from sim.simulation import simulate

BETA = 0.01725
ORDERS = pytest.mark.parametrize("order", [1, 2, 3])
STEP_S = 0.005


def setup(order=2, **fields):
    return Setup(
        **{
            "needle": NITINOL,
            "tissue": Tissue.uniform(viscous_n_mm_s_per_mm=BETA),
            "discretisation": Discretisation(order=order, step_s=STEP_S),
            "free_mm": 0.0,
            "inserted_mm": 200.0,
        }
        | fields
    )


def closed_form_pole():
    """The slowest, rad/s, of the needle 20 cm deep whose base is held."""
    held = InsertedNeedle(
        needle=NITINOL, damping_n_mm_s_per_mm=BETA, inserted_mm=200.0, drive=DriveKind.ANGLE
    )
    return held.poles_with_inertia_rad_s(1)[0]


def turn(model, made, base_deg=90.0):
    time = np.array([0.0, 0.1, 5.0])
    inputs = Schedule(
        time_s=time,
        drive=np.array([0.0, base_deg, base_deg]),
        free_mm=np.zeros(3),
        inserted_mm=np.full(3, 200.0),
        speed_mm_s=np.zeros(3),
    )
    return simulate([made], inputs, models=[model])[0]


def slowest_pole(model, made):
    """From the decay of the tip's lag once the second mode, nine times as fast, is gone."""
    run, h = turn(model, made), model.opt.timestep
    lag = run.base_deg - run.tip_deg
    late = run.time_s > 3.0
    factor = math.exp(np.polyfit(run.time_s[late], np.log(lag[late]), 1)[0] * h)
    # backward Euler multiplies a mode by 1 / (1 - h p), the others by about exp(h p)
    return (1 - 1 / factor) / h if made.discretisation.order == 1 else math.log(factor) / h


@ORDERS
def test_the_pole_of_the_model_as_compiled_is_that_of_the_closed_form(order):
    made = setup(order)
    assert slowest_pole(compile_model(made), made) == pytest.approx(closed_form_pole(), rel=1e-4)


@ORDERS
@pytest.mark.parametrize("factor", [0.5, 3.0])
def test_poles_follow_the_joint_stiffness(order, factor):
    made = setup(order)
    model = compile_model(made)
    model.jnt_stiffness[2:] *= factor  # joint 0 is the carriage's, joint 1 the base's servo
    assert slowest_pole(model, made) == pytest.approx(factor * closed_form_pole(), rel=1e-3)


@ORDERS
def test_poles_follow_the_inertia_of_the_bodies(order):
    """Root of eta s^2 + beta s - beta p = 0 (19), with p the pole without inertia."""
    made, times = setup(order), 5e6
    model = compile_model(made)
    model.body_inertia[2:] *= times
    eta = times * NITINOL.rotary_inertia_kg_m
    heavy = max(np.roots([eta, BETA, -BETA * closed_form_pole()]).real)
    assert heavy / closed_form_pole() > 1.02  # it matters
    assert slowest_pole(model, made) == pytest.approx(heavy, rel=1e-3)


@ORDERS
@pytest.mark.parametrize("field", ["actuator_gainprm", "actuator_gear"])
def test_a_servo_with_half_its_gain_turns_the_base_half_as_far(order, field):
    made = setup(order)
    model = compile_model(made)
    getattr(model, field)[0, 0] *= 0.5
    assert turn(model, made).base_deg[-1] == pytest.approx(45.0, abs=1e-3)


@ORDERS
def test_the_step_is_the_models(order):
    made = setup(order)
    model = compile_model(made)
    model.opt.timestep = 0.002
    assert np.diff(turn(model, made).time_s) == pytest.approx(0.002)
    assert slowest_pole(model, made) == pytest.approx(closed_form_pole(), rel=1e-4)


def test_springs_of_siblings_are_the_models_too():
    made = setup(discretisation=Discretisation(arrangement=Arrangement.SIBLINGS, step_s=STEP_S))
    model = compile_model(made)
    model.numeric("needle_springs").data[:] *= 0.5
    assert slowest_pole(model, made) == pytest.approx(closed_form_pole() / 2, rel=1e-3)


def test_what_the_callback_does_not_read_is_refused():
    """Negative control of the landing check: damping of a joint is not part of our needle."""
    made = setup()
    model = compile_model(made)
    model.dof_damping[3] = 1e-3
    with pytest.raises(SimulationFailed, match="stiffness, inertia, servos and step"):
        turn(model, made)


def test_a_motor_at_its_limit_gives_its_limit():
    """At 0.3 N mm the shaft ends up turning at torque / (beta l)."""
    drive = Drive(kind=DriveKind.TORQUE, torque_limit_n_mm=0.3, rotor_inertia_kg_m2=1e-8)
    made = setup(drive=drive)
    run = turn(compile_model(made), made, base_deg=5.0)  # as a torque: 5 N mm
    assert run.base_torque_n_mm[-1] == pytest.approx(0.3, rel=1e-6)
    rate = np.radians(np.gradient(run.tip_deg, run.time_s))[-1]
    assert rate == pytest.approx(0.3 / (BETA * 200), rel=1e-2)


def test_a_protocol_runs_on_a_model_from_a_file(tmp_path):
    protocol = protocol_named("fig5-5cm")
    model = compile_model(protocol.setup())
    model.jnt_stiffness[2:] *= 0.5
    soft, as_compiled = perform(protocol, model), perform(protocol)
    lags = [(r["base_angle_deg"] - r["tip_angle_deg"]).max() for r in (soft, as_compiled)]
    assert lags[0] > lags[1] + 5
