"""The step response on rigs that differ from what the controllers were designed for.

A plant differs in the tissue, in the needle or in the hardware of the loop; the last ones in all
of them. The predictive controllers know delays and servo, as the builder of a rig does;
no controller knows the other differences.
"""

import math
from dataclasses import replace

from controllers.limits import SUPERELASTIC_SHEAR_MPA, MotorLimits, ShaftLimits
from controllers.prediction import LoopTiming
from models.drive import Drive, DriveKind
from models.materials import MATERIALS
from models.needle import NITINOL
from models.servo import Servo
from models.tissue import Interface, Layer, Tissue
from sim.closed_loop import MeasurementNoise
from sim.loop.hardware import LoopHardware, Sensors
from studies.control.comparison import StepResponse, compare_on
from studies.control.step_response import DAMPING, DESIGN, NOISE, ControlPlant
from studies.control.tip_controllers import ControllerDesign

ROBUST_CONTROLLERS = (
    "base_only_at_limit",
    "base_only",
    "feedforward",
    "adaptive",
    "unbiased",
    "bias_tracking",
    "feedback",
    "lqr",
    "least_time",
    "friction_aware",
    "friction_aware_feedback",
    "predictive",
    "predictive_unbiased",
    "predictive_feedback",
)
WITH_TIMING = ("base_only_at_limit", "base_only", "predictive")
"""Baselines, and a controller whose design rests on the loop's delays."""
_HOLD_S = 6.0
_DELAY_S, _LATENCY_S = 0.04, 0.01
_SERVO = Servo(natural_frequency_hz=10.0)
_DRY_N_MM_PER_MM = 0.006  # 0.6 N mm over 10 cm
_ENCODER_DEG, _BIAS_N_MM = 0.36, 0.1
# A motor of 100 g cm^2 behind a gear of 1 to 1.6, as felt at the needle.
_MOTOR = Drive(kind=DriveKind.TORQUE, rotor_inertia_kg_m2=2.5e-5, torque_limit_n_mm=60.0)
_GENTLE = MotorLimits(
    shaft=ShaftLimits(
        needle=NITINOL, damping_n_mm_s_per_mm=DAMPING, shear_stress_mpa=SUPERELASTIC_SHEAR_MPA
    )
)
_LOUD = replace(NOISE, torque_n_mm=10 * NOISE.torque_n_mm)


def unmodelled_tissues() -> dict[str, Tissue]:
    """Tissues that differ from the viscous one that the estimator assumes."""
    return {
        tissue.name: tissue
        for tissue in (
            Tissue.uniform(name="damping x 1.5", viscous_n_mm_s_per_mm=1.5 * DAMPING),
            Tissue.uniform(name="damping x 0.5", viscous_n_mm_s_per_mm=0.5 * DAMPING),
            MATERIALS["soft-plastisol"],
            _layered("deep layer 4 x"),
            Tissue.uniform(
                name="dry friction", viscous_n_mm_s_per_mm=DAMPING, kinetic_n_mm_per_mm=_DRY_N_MM_PER_MM
            ),
        )
    }


def _layered(name: str, factor: float = 1.0, dry_n_mm_per_mm: float = 0.0) -> Tissue:
    """Two layers, one four times as viscous as the other; the mean is a factor times the assumed one."""
    shallow = factor * 2.0 / (1.0 + 4.0) * DAMPING
    interfaces = [
        Interface(viscous_n_mm_s_per_mm=viscous, kinetic_n_mm_per_mm=dry_n_mm_per_mm)
        for viscous in (shallow, 4 * shallow)
    ]
    return Tissue(
        name=name, layers=(Layer(interface=interfaces[0], fraction=0.5), Layer(interface=interfaces[1]))
    )


def _late(**sensors: float) -> LoopHardware:
    delays = dict.fromkeys(("base_delay_s", "torque_delay_s", "tip_delay_s"), _DELAY_S)
    return LoopHardware(sensors=Sensors(**delays, **sensors))


def _known(hardware: LoopHardware) -> LoopTiming:
    """Delays and servo of the hardware, as known to the builder of the rig."""
    return LoopTiming(
        measurement_delay_s=hardware.sensors.base_delay_s,
        command_latency_s=hardware.command_latency_s,
        servo=hardware.servo,
    )


def plants() -> dict[str, ControlPlant]:
    """All rigs by name; the first is the one that the controllers were designed for."""
    servo = LoopHardware(command_latency_s=_LATENCY_S, servo=_SERVO)
    biased = LoopHardware(sensors=Sensors(torque_bias_n_mm=_BIAS_N_MM))
    coarse = LoopHardware(sensors=Sensors(base_step_deg=_ENCODER_DEG))
    late_servo = _late().but(command_latency_s=_LATENCY_S, servo=_SERVO)
    gentle = replace(DESIGN, limits=_GENTLE)
    all_hardware = _late(torque_bias_n_mm=_BIAS_N_MM, base_step_deg=_ENCODER_DEG).but(
        command_latency_s=_LATENCY_S, servo=_SERVO
    )
    soft_shaft = NITINOL.but(shear_modulus_gpa=0.8 * NITINOL.shear_modulus_gpa)
    stiff_shaft = NITINOL.but(shear_modulus_gpa=1.2 * NITINOL.shear_modulus_gpa)
    every_tissue = _layered("layers x 1.5", 1.5)
    rigs = (
        ControlPlant(name="as designed"),
        *(ControlPlant(name=name, tissue=tissue) for name, tissue in unmodelled_tissues().items()),
        ControlPlant(name="stiffness x 0.8", needle=soft_shaft),
        ControlPlant(name="stiffness x 1.2", needle=stiff_shaft),
        ControlPlant(name="torque bias 0.1 N mm", hardware=biased),
        ControlPlant(name="delay 40 ms", hardware=_late()),
        ControlPlant(name="encoder 0.36 deg", hardware=coarse),
        ControlPlant(name="torque noise x 10", noise=_LOUD),
        ControlPlant(name="servo 10 Hz, 10 ms", hardware=servo),
        ControlPlant(name="motor 10 Hz, 10 ms", hardware=servo, drive=_MOTOR),
        ControlPlant(name="shear below 230 MPa", design=gentle),
        ControlPlant(name="shear, 40 ms, 10 Hz", hardware=late_servo, design=gentle),
        ControlPlant(
            name="all, no dry friction",
            tissue=every_tissue,
            needle=soft_shaft,
            hardware=all_hardware,
            noise=_LOUD,
        ),
        ControlPlant(
            name="all of it",
            tissue=_layered("layers x 1.5, dry", 1.5, _DRY_N_MM_PER_MM),
            needle=soft_shaft,
            hardware=all_hardware,
            noise=_LOUD,
        ),
    )
    return {rig.name: replace(rig, design=_informed(rig)) for rig in rigs}


def _informed(plant: ControlPlant) -> ControllerDesign:
    """A design with known delays, servo, encoder resolution and sensor noise."""
    noise = plant.noise or MeasurementNoise()
    timing, limits = _known(plant.hardware), plant.design.limits
    if limits.shaft is not None:
        limits = limits.but(shaft=limits.shaft.but(lateness_s=timing.lateness_s))
    rounding = plant.hardware.sensors.base_step_deg / math.sqrt(12)
    return replace(
        plant.design,
        timing=timing,
        limits=limits,
        base_noise_deg=max(plant.design.base_noise_deg, rounding),
        torque_noise_n_mm=max(plant.design.torque_noise_n_mm, noise.torque_n_mm),
    )


def misjudged_delays() -> dict[str, ControlPlant]:
    """The rig with late sensors, with controllers that assume wrong delays."""
    late = plants()["delay 40 ms"]
    return {
        name: replace(late, name=name, design=replace(late.design, timing=timing))
        for name, timing in (
            (f"delay 40 ms, {1e3 * assumed:.0f} ms assumed", LoopTiming(measurement_delay_s=assumed))
            for assumed in (0.02, 0.06, 0.08)
        )
    }


def robustness(
    depth_cm: float = 10.0,
    free_mm: float = 50.0,
    *,
    rigs: tuple[str, ...] | None = None,
    controllers: tuple[str, ...] = ROBUST_CONTROLLERS,
) -> list[StepResponse]:
    """Every controller on every rig, or on those that are named."""
    known, misjudged = plants(), misjudged_delays()
    made = []
    for name in rigs or (*known, *misjudged):
        rig = known.get(name) or misjudged[name]
        chosen = controllers if name in known else WITH_TIMING
        made += compare_on(rig, depth_cm=depth_cm, free_mm=free_mm, controllers=chosen, hold_s=_HOLD_S)
    return made
