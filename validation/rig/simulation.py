"""A trial of the rig: the motion of the needle, and the readings of ideal sensors."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from validation.rig.integrator import integrate
from validation.rig.laws.interface import preslide
from validation.rig.laws.parameters import LawParameters
from validation.rig.mesh import MeshSize
from validation.rig.motion import TrialMotion
from validation.rig.rig import IndependentRig
from validation.rig.unmodelled.effect import IdealSignals
from validation.rig.unmodelled.library import EFFECTS

Array = NDArray[np.float64]


class CellCounts(NamedTuple):
    """Numbers of cells: inserted shaft; free shaft in a sheath; whole shaft if the depth changes."""

    inserted: int
    sheath: int
    needle: int


FINE, COARSE = CellCounts(72, 60, 150), CellCounts(24, 20, 60)


def simulate_twist(
    law: LawParameters, motion: TrialMotion, cells: CellCounts = FINE
) -> tuple[Array, Array]:
    """Tip angle, rad, and drive torque, N mm, on the fine grid, (N,) each.

    Raises:
      RuntimeError: no balance of torques was found; the message names the time.
    """
    sheath = cells.sheath if law.sheath > 0 else 0
    mesh = MeshSize(sheath + cells.inserted + 2, sheath, False)
    if motion.growing:
        mesh = MeshSize(cells.needle + 1, 0, True)
    tip_torque = 0.0 if motion.tip_torque_n_mm is None else motion.tip_torque_n_mm
    drive = np.empty((6, motion.base_deg.size))
    drive[0], drive[1], drive[2] = np.radians(motion.base_deg), motion.inserted_mm, motion.free_mm
    drive[3], drive[4], drive[5] = motion.speed_mm_s, tip_torque, motion.time_s
    tip, torque, lost = integrate(law, mesh, motion.dt_s, drive)
    if lost >= 0:
        raise RuntimeError(f"no balance of torques was found at {lost * motion.dt_s} s with {law}")
    return np.asarray(tip), np.asarray(torque)


def ideal_signals(rig: IndependentRig, motion: TrialMotion, cells: CellCounts = FINE) -> IdealSignals:
    """Readings of noise-free sensors in the trial, on the fine grid.

    `motion` has the true base angle of the drive shaft, and the lengths that the log states.
    """
    law = rig.law()
    tip, torque = simulate_twist(law, _at_chuck(rig, _true_lengths(rig, motion)), cells)
    bearing = rig.sensor("drive_friction", "level")
    if bearing:
        torque = torque + bearing * presliding_shares(np.radians(motion.base_deg), law.limit)
    delay_s = rig.sensor("tip_sensor_delay", "delay")
    tip = np.interp(motion.time_s - delay_s, motion.time_s, np.degrees(tip))
    torque_delay_s = rig.sensor("torque_sensor_delay", "delay")
    torque = np.interp(motion.time_s - torque_delay_s, motion.time_s, torque)
    signals = IdealSignals(
        time_s=motion.time_s,
        base_deg=rig.sensor("base_angle_scale", "scale") * motion.base_deg,
        torque_n_mm=rig.sensor("torque_scale", "scale") * torque + rig.sensor("torque_bias", "bias"),
        tip_deg=rig.sensor("tip_angle_scale", "scale") * tip + rig.sensor("tip_angle_bias", "bias"),
        speed_mm_s=motion.speed_mm_s,
        trial=motion.trial,
    )
    for name, parameters in rig.outside.items():
        if name in EFFECTS and (shown := EFFECTS[name].signals):
            signals = shown(signals, parameters)
    return signals


def _at_chuck(rig: IndependentRig, motion: TrialMotion) -> TrialMotion:
    """The motion with the base angle that reaches the chuck."""
    for name, parameters in rig.outside.items():
        if name in EFFECTS and (reached := EFFECTS[name].drive):
            motion = replace(motion, base_deg=reached(motion, parameters))
    return motion


def _true_lengths(rig: IndependentRig, motion: TrialMotion) -> TrialMotion:
    """The motion with the lengths that the needle has, not those that the log states."""
    return replace(
        motion,
        inserted_mm=motion.inserted_mm + rig.sensor("inserted_offset", "offset"),
        free_mm=motion.free_mm + rig.unlisted("free_length_error", "offset"),
    )


@njit(cache=True)
def presliding_shares(turned: Array, limit: float) -> Array:
    """Torque of a dry bearing / its level, for a shaft with these angles, rad, (N,)."""
    shares = np.zeros_like(turned)
    for i in range(1, turned.size):
        travel = turned[i] - turned[i - 1]
        shares[i] = preslide(limit, shares[i - 1] * limit, travel)[0] / limit
    return shares


def compile_kernels() -> None:
    """Compile the integrator, or load it from numba's cache; processes forked later inherit it."""
    still = np.zeros(2)
    motion = TrialMotion(
        dt_s=0.01,
        per_sample=1,
        base_deg=still,
        inserted_mm=still + 50.0,
        free_mm=still + 50.0,
        speed_mm_s=still,
    )
    simulate_twist(IndependentRig(damping_n_mm_s_per_mm=0.02).law(), motion, CellCounts(2, 2, 2))
