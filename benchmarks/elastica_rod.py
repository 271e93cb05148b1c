"""The rig's turn in PyElastica. Runs by itself, in an interpreter that has PyElastica.

A straight Cosserat rod of true density; its first element turns as the base does. The
rod is longer by half an element, so that this element's centre is the base. Reads the
rig from standard input and writes what it measured to standard output, both JSON, SI.

The drag of the tissue on the twisting rod is either an external torque, as PyElastica
has it, or a damper of our own that takes the same drag implicitly. A step counts as
stable if the rod, disturbed by 1 um/s, is not moving 100 times faster after the trial.
Left exactly straight, it twists alone: whatever else is unstable never starts.
"""

import json
import sys
import time
from dataclasses import dataclass
from importlib.metadata import version
from typing import Any

import elastica as ea
import numpy as np
from elastica.boundary_conditions import ConstraintBase
from elastica.dissipation import DamperBase
from elastica.external_forces import NoForces
from numpy.typing import NDArray

Array = NDArray[np.float64]

_TRIAL_STEPS = 2000
_KICK_M_S = 1e-6
_GROWTH = 100.0
_TORQUE_STEPS_S = (1.2e-8, 1e-8, 8e-9, 6e-9, 4e-9)
_DAMPER_STEPS_S = (1e-6, 5e-7, 2e-7, 1.5e-7, 1.2e-7, 1e-7, 7e-8, 5e-8)
_STRAIGHT_STEPS_S = (1e-3, 1e-4)
_YOUNGS_PA = 75e9  # of Nitinol; sets what is stable, not how the rod twists


@dataclass(frozen=True, kw_only=True)
class Rig:
    """As `benchmarks.pyelastica` sends it, SI."""

    length: float
    radius: float
    density: float
    shear_modulus: float
    damping: float
    turn_rad: float
    turn_s: float
    end_s: float
    elements: int


class Turn(ConstraintBase):  # type: ignore[misc]
    """Turns the first element about the rod as the base turns."""

    def __init__(self, *fixed: Any, rig: Rig, **kwargs: Any) -> None:
        super().__init__(*fixed, **kwargs)
        self.rig = rig

    def constrain_values(self, system: Any, time: float) -> None:
        """Position of the first node, directors of the first element."""
        angle = self.rig.turn_rad * min(time / self.rig.turn_s, 1.0)
        cos, sin = np.cos(angle), np.sin(angle)
        system.position_collection[:, 0] = 0.0
        system.director_collection[:, :, 0] = [[0, cos, sin], [0, -sin, cos], [1, 0, 0]]

    def constrain_rates(self, system: Any, time: float) -> None:
        """Their rates."""
        system.velocity_collection[:, 0] = 0.0
        rate = self.rig.turn_rad / self.rig.turn_s if time < self.rig.turn_s else 0.0
        system.omega_collection[:, 0] = 0.0, 0.0, rate


class DragTorque(NoForces):  # type: ignore[misc]
    """Drag as an external torque: explicit."""

    def __init__(self, rig: Rig) -> None:
        super().__init__()
        self.damping = rig.damping

    def apply_torques(self, system: Any, time: float = 0.0) -> None:
        """Minus damping times rate, on every element but the driven one."""
        drag = self.damping * system.rest_lengths * system.omega_collection[2]
        system.external_torques[2, 1:] -= drag[1:]


class DragDamper(DamperBase):  # type: ignore[misc]
    """The same drag, taken at the end of the step."""

    def __init__(self, rig: Rig, step_s: float, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        inertia = rig.density * np.pi * rig.radius**4 / 2
        self.kept = 1.0 / (1.0 + step_s * rig.damping / inertia)

    def dampen_rates(self, system: Any, time: float) -> None:
        """Of rotation about the rod."""
        system.omega_collection[2, 1:] *= self.kept


class Simulator(ea.BaseSystemCollection, ea.Constraints, ea.Damping, ea.Forcing):  # type: ignore[misc]
    """One rod, one end turned."""


def build(rig: Rig, step_s: float, *, damper: bool, kick_m_s: float) -> tuple[Simulator, Any]:
    """The rod at rest, disturbed by random velocities."""
    length = rig.length * rig.elements / (rig.elements - 0.5)
    rod = ea.CosseratRod.straight_rod(
        rig.elements,
        np.zeros(3),
        np.array([1.0, 0.0, 0.0]),
        np.array([0.0, 1.0, 0.0]),
        length,
        rig.radius,
        rig.density,
        youngs_modulus=_YOUNGS_PA,
        shear_modulus=rig.shear_modulus,
    )
    simulator = Simulator()
    simulator.append(rod)
    held = simulator.constrain(rod)
    held.using(Turn, rig=rig, constrained_position_idx=(0,), constrained_director_idx=(0,))
    if damper:
        simulator.dampen(rod).using(DragDamper, rig=rig, step_s=step_s)
    else:
        simulator.add_forcing_to(rod).using(DragTorque, rig=rig)
    simulator.finalize()
    noise = np.random.default_rng(0).standard_normal((3, rig.elements))
    rod.velocity_collection[:, 1:] = kick_m_s * noise
    return simulator, rod


def trial(rig: Rig, step_s: float, *, damper: bool) -> tuple[bool, float]:
    """Whether a step is stable, and CPU time a step, s."""
    simulator, rod = build(rig, step_s, damper=damper, kick_m_s=_KICK_M_S)
    stepper, now = ea.PositionVerlet(), 0.0
    start = time.process_time()
    for _ in range(_TRIAL_STEPS):
        now = stepper.step(simulator, now, step_s)
    taken = time.process_time() - start
    fastest = float(np.abs(rod.velocity_collection).max())
    return fastest < _GROWTH * _KICK_M_S, taken / _TRIAL_STEPS


def largest_stable(rig: Rig, steps_s: tuple[float, ...], *, damper: bool) -> dict[str, float]:
    """The first of falling steps that is stable, and what 8 s cost at it."""
    for step_s in steps_s:
        if trial(rig, step_s, damper=damper)[0]:
            cost = min(trial(rig, step_s, damper=damper)[1] for _ in range(3))
            return {"step_s": step_s, "cpu_a_step_s": cost}
    raise RuntimeError(f"PyElastica is unstable at every step tried: {steps_s} s")


def undisturbed(rig: Rig, step_s: float) -> dict[str, Any]:
    """The whole run of an exactly straight rod with our damper."""
    simulator, rod = build(rig, step_s, damper=True, kick_m_s=0.0)
    stepper, now, times, tips = ea.PositionVerlet(), 0.0, [], []
    every = round(0.02 / step_s)
    start = time.process_time()
    steps = round(rig.end_s / step_s)
    for k in range(1, steps + 1):
        now = stepper.step(simulator, now, step_s)
        if k % every == 0:
            last, before = np.arctan2(*rod.director_collection[0, :0:-1, [-1, -2]].T)
            times.append(float(now))
            tips.append(float((9 * last - before) / 8))
    cost = (time.process_time() - start) / steps
    return {"step_s": step_s, "cpu_a_step_s": cost, "time_s": times, "tip_rad": tips}


def main() -> None:
    """Measure and write."""
    rig = Rig(**json.load(sys.stdin))
    with np.errstate(all="ignore"):
        found = {
            "version": version("pyelastica"),
            "torque": largest_stable(rig, _TORQUE_STEPS_S, damper=False),
            "damper": largest_stable(rig, _DAMPER_STEPS_S, damper=True),
            "undisturbed": [undisturbed(rig, step_s) for step_s in _STRAIGHT_STEPS_S],
        }
    print(json.dumps(found))


if __name__ == "__main__":
    main()
