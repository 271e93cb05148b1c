"""The rig of `benchmarks.sysid`: its logs, and the model of it that plain MuJoCo has.

Logs come from the independent rig of `validation.rig` (finite volumes, no MuJoCo), with
the noise of the format document. Lengths hardly change, so that a model whose lengths are
fixed can replay them; one trial slides just fast enough to tell laws of dry friction apart.

The plain model has no callback. A joint's damping between two elements would be the
needle's own, so each element hinges on the tissue: the joint's `damping` is that of
the tissue around the element, its `frictionloss` the dry torque there. Tendons between
neighbours have the shaft's stiffness; the free shaft is a position servo of its own
stiffness, whose target is the base angle and whose force is the base torque. Springs
and servo are implicit (integrator `discrete`), and steps of 1 ms will do.
"""

from collections.abc import Sequence
from pathlib import Path

import mujoco
import numpy as np
import pandas as pd
import yaml
from numpy.typing import NDArray

from diagnosis.log.nominal_rig import NominalRig
from diagnosis.log.trial import Trial
from models import units
from models.needle import Needle
from validation.rig.modelled import Effects
from validation.rig.motion import TrialMotion
from validation.rig.rig import IndependentRig
from validation.rig.simulation import ideal_signals

Array = NDArray[np.float64]

TIP, TORQUE = "tip_angle_deg", "base_torque_n_mm"
STEP_S = 1e-3
ELEMENTS = 12  # of the inserted shaft
NEEDLE = {"diameter_mm": 0.59, "shear_modulus_gpa": 27.2, "density_g_cm3": 6.45}
DAMPING_N_MM_S_PER_MM = 0.01725
NOISE = {"tip_angle_noise_deg": 0.4, "base_torque_noise_n_mm": 0.015, "base_angle_noise_deg": 0.02}

_UNITS = {"base_angle": "deg", "base_torque": "n_mm", "tip_angle": "deg"}
# Corners of the base angle, s and deg; inserted and free length, mm; axial speed, mm/s.
_TRIALS = (
    ([0, 0.5, 0.9, 3.0, 3.5, 6.0], [0, 0, 90, 90, -20, -20], 100.0, 60.0, 0.0),
    ([0, 1.0, 7.0, 9.0, 12.0], [0, 0, 60, 60, 20], 60.0, 90.0, -0.1),
    ([0, 0.5, 1.1, 4.0, 7.0], [0, 0, -120, -120, -60], 150.0, 40.0, 0.0),
    ([0, 0.5, 2.5, 4.5, 6.5, 8.0], [0, 0, 45, -45, 30, 30], 100.0, 60.0, 0.0),
)
_FINE_S, _PER_SAMPLE = 2.5e-3, 4  # a log of 100 Hz
_FIXED = 0.02  # a length that changes by less is taken at its mean
# MuJoCo's default impedance, 0.9, lets dry friction creep: residuals of up to 1.5 times the noise.
_STICKS = [0.999, 0.999, 0.001, 0.5, 2]


def write_log(folder: Path, effects: Effects) -> Path:
    """Write the log of a rig with these effects (names and units of the vocabulary)."""
    folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(0)
    rig = IndependentRig(
        damping_n_mm_s_per_mm=DAMPING_N_MM_S_PER_MM,
        diameter_mm=NEEDLE["diameter_mm"],
        shear_modulus_gpa=NEEDLE["shear_modulus_gpa"],
        effects=effects,
    )
    names = [f"trial_{i + 1:02d}.csv" for i in range(len(_TRIALS))]
    for name, trial in zip(names, _TRIALS, strict=True):
        table = _measured(rig, _motion(*trial), rng)
        table.to_csv(folder / name, index=False, float_format="%.4f")
    believed = {
        "format": "rig-log/1",
        "needle": NEEDLE,
        "tissue": {"damping_n_mm_s_per_mm": DAMPING_N_MM_S_PER_MM},
        "sensors": NOISE,
        "trials": [{"file": name} for name in names],
    }
    (folder / "rig.yaml").write_text(yaml.safe_dump(believed, sort_keys=False), encoding="utf-8")
    return folder


def _motion(
    corners: Sequence[float], angles: Sequence[float], inserted: float, free: float, speed: float
) -> TrialMotion:
    time = np.arange(0, corners[-1], _FINE_S)
    return TrialMotion(
        dt_s=_FINE_S,
        per_sample=_PER_SAMPLE,
        base_deg=np.interp(time, corners, angles),
        inserted_mm=np.full(time.size, inserted),
        free_mm=free - speed * time,
        speed_mm_s=np.full(time.size, speed),
    )


def _measured(rig: IndependentRig, motion: TrialMotion, rng: np.random.Generator) -> pd.DataFrame:
    """Samples of what ideal sensors show, with noise."""
    seen, every = ideal_signals(rig, motion), slice(None, None, _PER_SAMPLE)
    ideal = {"base_angle": seen.base_deg, "base_torque": seen.torque_n_mm, "tip_angle": seen.tip_deg}
    sigma = {name: NOISE[f"{name}_noise_{_UNITS[name]}"] for name in ideal}
    return pd.DataFrame(
        {
            "time_s": seen.time_s[every],
            **{
                f"{name}_{_UNITS[name]}": values[every] + rng.normal(0, sigma[name], values[every].size)
                for name, values in ideal.items()
            },
            "inserted_mm": motion.inserted_mm[every],
            "free_mm": motion.free_mm[every],
            "speed_mm_s": motion.speed_mm_s[every],
        }
    )


def unfit(trial: Trial) -> str:
    """Why the plain model cannot replay a trial; empty if it can."""
    for name in ("inserted_mm", "free_mm"):
        if trial[name].min() <= 0:
            return f"{name} is 0"
        if np.ptp(trial[name]) > _FIXED * trial[name].mean():
            return f"{name} changes"
    if trial.has("tip_torque_n_mm"):
        return "a torque acts on its tip"
    return "" if trial.has(TIP) and trial.has(TORQUE) else "tip angle or base torque is missing"


def plain_spec(rig: NominalRig, trial: Trial) -> mujoco.MjSpec:
    """The nominal needle of a trial; input: base angle, rad; sensors: `TIP`, rad, `TORQUE`, N m."""
    free, inserted = (trial[name].mean() * units.MM for name in ("free_mm", "inserted_mm"))
    needle = Needle(**dict(rig.needle), length_mm=(free + inserted) / units.MM)
    spec = mujoco.MjSpec()
    spec.option.timestep = STEP_S
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_DISCRETE
    spec.option.gravity = [0, 0, 0]
    for i, node in enumerate(free + np.linspace(0.0, inserted, ELEMENTS + 1)):
        share = inserted / ELEMENTS
        body = spec.worldbody.add_body(
            name=f"shaft_{i}",
            pos=[0, 0, node],
            mass=needle.mass_kg_per_m * share,
            inertia=[needle.rotary_inertia_kg_m * share] * 3,
            explicitinertial=True,
        )
        joint = body.add_joint(name=f"twist_{i}", type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 0, 1])
        joint.solimp_friction = _STICKS
        if i > 0:
            tendon = spec.add_tendon(name=f"torsion_{i}")
            tendon.wrap_joint(f"twist_{i - 1}", -1)
            tendon.wrap_joint(f"twist_{i}", 1)
    hinge, actuator = mujoco.mjtObj.mjOBJ_JOINT, mujoco.mjtObj.mjOBJ_ACTUATOR
    angle, force = mujoco.mjtSensor.mjSENS_JOINTPOS, mujoco.mjtSensor.mjSENS_ACTUATORFRC
    spec.add_actuator(name="drive", target="twist_0", trntype=mujoco.mjtTrn.mjTRN_JOINT)
    spec.add_sensor(name=TIP, type=angle, objtype=hinge, objname=f"twist_{ELEMENTS}")
    spec.add_sensor(name=TORQUE, type=force, objtype=actuator, objname="drive")
    set_rigidity(spec, needle.rigidity_n_mm2 * units.N_MM2)
    set_damping(spec, rig.tissue.damping_n_mm_s_per_mm)
    return spec


def set_rigidity(spec: mujoco.MjSpec, rigidity_n_m2: float) -> None:
    """Torsional rigidity of the shaft, N m^2, into the servo (free shaft) and the tendons."""
    free, *inside = rigidity_n_m2 / np.diff(_nodes_m(spec), prepend=0.0)
    spec.actuator("drive").set_to_position(kp=free)
    for tendon, stiffness in zip(spec.tendons, inside, strict=True):
        tendon.stiffness = [stiffness, 0, 0]


def set_damping(spec: mujoco.MjSpec, damping: float) -> None:
    """Viscous torque per rad/s and length of tissue, N mm s / mm or N m s / m: the same number."""
    for joint, length in zip(spec.joints, _in_tissue_m(spec), strict=True):
        joint.damping = [damping * length, 0, 0]


def set_dry_torque(spec: mujoco.MjSpec, level: float) -> None:
    """Dry torque per length of tissue, N mm / mm or N m / m, as MuJoCo's friction loss."""
    for joint, length in zip(spec.joints, _in_tissue_m(spec), strict=True):
        joint.frictionloss = level * length


def _nodes_m(spec: mujoco.MjSpec) -> Array:
    """From the chuck, m."""
    return np.array([body.pos[2] for body in spec.worldbody.bodies])


def _in_tissue_m(spec: mujoco.MjSpec) -> Array:
    """How much tissue each node stands for, m: half of it at the entry and at the tip."""
    lengths = np.diff(_nodes_m(spec))
    return np.asarray(0.5 * (np.append(lengths, 0.0) + np.append(0.0, lengths)))
