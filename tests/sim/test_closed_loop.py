"""The loop around a controller: what it measures, what it moves, and what it records."""

import numpy as np
import pytest

from models.drive import Drive
from models.needle import NITINOL
from models.servo import Servo
from models.tissue import Tissue
from sim.closed_loop import MeasurementNoise, run_closed_loop
from sim.discretisation import Discretisation, Mesh
from sim.loop.hardware import LoopHardware, Sensors
from sim.loop.shaft import CommandedShaft
from sim.needles.kept import compile_model
from sim.needles.run import SimulationFailed
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate

STEP_S = 0.005


class Follower:
    """Turns the base to the reference, and advances as it is told; keeps what it was shown."""

    def __init__(self, advance_mm=lambda time_s: 0.0):
        self.measurements, self.references, self._advance = [], [], advance_mm

    def __call__(self, measurement, reference_deg):
        self.measurements.append(measurement)
        self.references.append(reference_deg)
        return reference_deg

    @property
    def advance_mm(self):
        return self._advance(self.measurements[-1].time_s)

    def shown(self, name):
        return np.array([getattr(m, name) for m in self.measurements])


def setup(mesh=Mesh.EULERIAN, drive=Drive(), step_s=STEP_S):  # noqa: B008 - frozen
    return Setup(
        needle=NITINOL,
        drive=drive,
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=0.017),
        discretisation=Discretisation(elements=8, step_s=step_s),
        mesh=mesh,
        free_mm=50,
        inserted_mm=60,
    )


def turn(duration_s=0.5):
    time = np.array([0.0, 0.1, duration_s])
    return Schedule(
        time_s=time,
        drive=np.array([0.0, 45.0, 45.0]),
        free_mm=np.full(3, 50.0),
        inserted_mm=np.full(3, 60.0),
        speed_mm_s=np.zeros(3),
    )


def test_a_controller_that_returns_the_reference_gives_the_open_loop_one_step_late():
    controlled = run_closed_loop(setup(), turn(), Follower())
    late = controlled.run.inputs
    assert late.drive[1:] == pytest.approx(controlled.reference_deg[:-1])
    assert late.drive[0] == 0.0
    open_loop = simulate([setup()], late)[0]
    # the same steps of the same model, by a batch: equal but for rounding
    assert np.abs(open_loop.tip_deg - controlled.run.tip_deg).max() < 1e-10
    assert np.ptp(controlled.run.tip_deg) > 10


def test_without_noise_the_controller_sees_the_recorded_run():
    follower = Follower()
    run = run_closed_loop(setup(), turn(), follower).run
    assert np.array_equal(follower.shown("time_s"), run.time_s)
    assert np.array_equal(follower.shown("base_deg"), run.inputs.drive)
    assert np.array_equal(follower.shown("tip_deg"), run.tip_deg)
    assert np.array_equal(follower.shown("torque_n_mm"), run.base_torque_n_mm)


def test_progress_is_told_every_thousand_steps():
    told = []
    run_closed_loop(setup(step_s=0.0004), turn(1.0), Follower(), progress=told.append)
    assert told == pytest.approx([0.0, 1000 / 2501, 2000 / 2501])


def test_noise_has_the_stated_spread_and_is_the_same_for_the_same_seed():
    noise = MeasurementNoise(base_deg=0.02, torque_n_mm=0.015, tip_deg=0.2, seed=3)
    shown = []
    for _ in range(2):
        follower = Follower()
        run = run_closed_loop(setup(), turn(2.0), follower, noise=noise).run
        exact = {
            "base_deg": run.inputs.drive,
            "torque_n_mm": run.base_torque_n_mm,
            "tip_deg": run.tip_deg,
        }
        shown.append({name: follower.shown(name) - values for name, values in exact.items()})
    for name, errors in shown[0].items():
        assert np.array_equal(errors, shown[1][name])
        # The spread of N samples is known to 1 / sqrt(2 N): four times that is 14 %.
        assert errors.std() == pytest.approx(getattr(noise, name), rel=4 / np.sqrt(2 * errors.size))


def test_the_needle_is_turned_by_the_shaft_behind_latency_and_servo():
    hardware = LoopHardware(command_latency_s=0.01, servo=Servo(natural_frequency_hz=10))
    controlled = run_closed_loop(setup(), turn(), Follower(), hardware=hardware)
    shaft = CommandedShaft(hardware, step_s=STEP_S)
    followed = [shaft.follow(x) for x in controlled.command_deg[:-1]]
    assert np.array_equal(controlled.command_deg, controlled.reference_deg)
    assert controlled.shaft_deg[1:] == pytest.approx(followed)
    late = simulate([setup()], controlled.run.inputs)[0]
    assert np.abs(late.tip_deg - controlled.run.tip_deg).max() < 1e-10


@pytest.mark.parametrize("mesh", Mesh)
def test_a_motor_whose_servo_reads_an_encoder_turns_the_needle_as_the_filtered_command_does(mesh):
    """Both fidelities of the drive; their difference halves with the step."""
    hardware = LoopHardware(servo=Servo(natural_frequency_hz=8))
    motor = Drive(kind="torque", rotor_inertia_kg_m2=2.5e-5)
    apart = []
    for step_s in (0.002, 0.001):
        filtered, turned = (
            run_closed_loop(setup(mesh, drive, step_s), turn(), Follower(), hardware=hardware)
            for drive in (Drive(), motor)
        )
        apart.append(np.abs(filtered.shaft_deg - turned.shaft_deg).max())
        torques = (made.measured["torque_n_mm"] for made in (filtered, turned))
        assert np.abs(np.subtract(*torques)).max() < 0.1 * filtered.measured["torque_n_mm"].max()
    assert apart[0] < 2.0
    assert apart[1] == pytest.approx(apart[0] / 2, rel=0.1)


def test_mujoco_clips_the_motor_to_its_torque_limit():
    hardware = LoopHardware(servo=Servo(natural_frequency_hz=8))
    motor = Drive(kind="torque", rotor_inertia_kg_m2=2.5e-5, torque_limit_n_mm=5.0)
    run = run_closed_loop(setup(drive=motor), turn(), Follower(), hardware=hardware).run
    assert np.abs(run.base_torque_n_mm).max() == pytest.approx(5.0)
    assert run.base_deg[-1] == pytest.approx(45.0, abs=2.0)


def test_the_controller_sees_what_the_sensors_show_and_the_run_keeps_it():
    sensors = Sensors(base_step_deg=0.36, base_delay_s=0.02, torque_bias_n_mm=0.1, torque_delay_s=0.02)
    follower = Follower()
    made = run_closed_loop(setup(), turn(), follower, hardware=LoopHardware(sensors=sensors))
    for name, values in made.measured.items():
        assert np.array_equal(follower.shown(name), values)
    late = np.concatenate([np.zeros(4), made.run.inputs.drive[:-4]])
    assert made.measured["base_deg"] == pytest.approx(0.36 * np.round(late / 0.36))
    assert made.measured["torque_n_mm"][4:] == pytest.approx(made.run.base_torque_n_mm[:-4] + 0.1)
    assert np.array_equal(made.measured["tip_deg"], made.run.tip_deg)


def test_a_retraction_beside_the_schedule_moves_the_chuck_through_a_slab():
    follower = Follower(lambda time_s: -3.0 * min(time_s / 0.2, 1.0))
    run = run_closed_loop(setup(), turn(), follower).run
    assert run.inputs.free_mm[-1] == pytest.approx(53.0)
    assert run.inputs.inserted_mm == pytest.approx(60.0)


@pytest.mark.parametrize(("advance", "left"), [(-20.0, 40.0), (-90.0, 0.0)])
def test_on_a_lagrangian_mesh_a_retraction_shortens_what_is_inserted(advance, left):
    follower = Follower(lambda time_s: advance * min(time_s / 0.4, 1.0))
    run = run_closed_loop(setup(Mesh.LAGRANGIAN), turn(), follower).run
    assert run.inputs.inserted_mm[-1] == pytest.approx(left)
    assert follower.shown("inserted_mm") == pytest.approx(run.inputs.inserted_mm)


def test_signals_of_the_controller_are_kept_at_every_sample():
    follower = Follower()
    controlled = run_closed_loop(
        setup(), turn(), follower, log=lambda: {"seen": follower.references[-1]}, keep_shape=True
    )
    assert np.array_equal(controlled.log["seen"], controlled.reference_deg)
    assert controlled.run.angles_rad.shape == (controlled.reference_deg.size, 10)
    assert run_closed_loop(setup(), turn(), Follower()).run.angles_rad is None


def test_a_loop_whose_steps_do_not_land_is_refused_like_any_other_run(monkeypatch):
    """Damping of a joint is nothing that the tissue's callback knows of."""

    def damped(made):
        model = compile_model(made)
        model.dof_damping[3] = 1e-3
        return model

    monkeypatch.setattr("sim.closed_loop.compile_model", damped)
    with pytest.raises(SimulationFailed, match="step to end within"):
        run_closed_loop(setup(), turn(), Follower())
