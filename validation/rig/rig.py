"""The rig: a needle in tissue, its effects, and what ideal sensors show of a trial."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from validation.rig.laws import Law
from validation.rig.march import march
from validation.rig.mesh import Mesh
from validation.rig.unmodelled import IN_LAW, IN_SENSORS, OUTSIDE, Trace

Array = NDArray[np.float64]
Effects = Mapping[str, Mapping[str, float]]

CONSTANT_LENGTH_MM = 1e-6

LAW_FIELDS: dict[str, dict[str, str]] = {
    "coulomb_friction": {"level": "coulomb"},
    "stiction": {"kinetic": "kinetic", "static": "static", "stribeck": "stribeck"},
    "speed_dependent_friction": {"level": "shared"},
    "shear_thinning": {"exponent": "exponent"},
    "tissue_viscoelasticity": {"stiffness": "softness", "time_constant": "retardation"},
    "layered_tissue": {"ratio": "ratio", "boundary": "boundary"},
    "entry_friction": {"level": "entry"},
    "sheath_friction": {"level": "sheath"},
    "load_dependent_friction": {"coefficient": "load"},
    "chuck_backlash": {"gap": "half_gap"},
    "base_compliance": {"stiffness": "base_softness"},
    "tip_drag": {"damping": "tip_drag"},
    "needle_curvature": {"torque": "curvature", "phase": "phase"},
    "stiffness_error": {"scale": "rigidity"},
    "damping_error": {"scale": "damping"},
}
"""Where the parameters of each effect of the machine go in the law."""

SENSOR_FIELDS: dict[str, dict[str, float]] = {
    "tip_angle_bias": {"bias": 0.0},
    "tip_angle_scale": {"scale": 1.0},
    "tip_sensor_delay": {"delay": 0.0},
    "torque_bias": {"bias": 0.0},
}
"""Parameters of the effects of sensors, and the values that switch them off."""

VOCABULARY = (*LAW_FIELDS, *SENSOR_FIELDS)


class Fineness(NamedTuple):
    """Cells: of the inserted shaft, of the free one under a sheath; of all if its depth changes."""

    inserted: int
    sheath: int
    needle: int


FINE, COARSE = Fineness(72, 60, 150), Fineness(24, 20, 60)


@dataclass(frozen=True, kw_only=True)
class Motion:
    """What drives a trial, (N,) each, on a time grid that is `per_sample` times finer than the log."""

    dt_s: float
    per_sample: int
    base_deg: Array
    inserted_mm: Array
    free_mm: Array
    speed_mm_s: Array
    tip_torque_n_mm: Array | None = None

    @property
    def time_s(self) -> Array:
        """Of the fine grid."""
        return np.asarray(np.arange(self.base_deg.size) * self.dt_s)

    @property
    def growing(self) -> bool:
        """Whether the inserted length changes."""
        return bool(np.ptp(self.inserted_mm) > CONSTANT_LENGTH_MM)


@dataclass(frozen=True, kw_only=True)
class Rig:
    """A needle in tissue.

    Attributes:
      effects: of the vocabulary: effect -> parameter -> value, units as in reports.
      outside: effects outside the vocabulary, parameters as in `outside`.

    Raises:
      ValueError: an effect is unknown, or its parameters are not those of the vocabulary.
    """

    damping_n_mm_s_per_mm: float
    diameter_mm: float = 0.59
    shear_modulus_gpa: float = 27.2
    effects: Effects = field(default_factory=dict)
    outside: Effects = field(default_factory=dict)

    def __post_init__(self) -> None:
        known = {name: sorted(fields) for name, fields in (LAW_FIELDS | SENSOR_FIELDS).items()}
        for effect, parameters in self.effects.items():
            if effect not in known:
                raise ValueError(f"effects: {effect!r}; expected some of {', '.join(VOCABULARY)}")
            if sorted(parameters) != known[effect]:
                raise ValueError(
                    f"effects: {effect} with {sorted(parameters)}; expected {known[effect]}"
                )
        for effect in self.outside:
            if effect not in OUTSIDE:
                raise ValueError(f"outside: {effect}; expected one of {', '.join(OUTSIDE)}")

    def law(self) -> Law:
        """Parameters in the units of `laws`."""
        rigidity = math.pi * self.diameter_mm**4 / 32 * self.shear_modulus_gpa * 1e3
        law = Law(rigidity, self.damping_n_mm_s_per_mm, self.diameter_mm / 2)
        for effect, parameters in self.effects.items():
            for name, target in LAW_FIELDS.get(effect, {}).items():
                law = law._replace(**{target: _in_law(target, law, parameters[name])})
        for effect, parameters in self.outside.items():
            law = IN_LAW[effect](law, parameters) if effect in IN_LAW else law
        return law

    def sensor(self, effect: str, parameter: str) -> float:
        """A parameter of a sensor effect, or its neutral value."""
        return float(self.effects.get(effect, SENSOR_FIELDS[effect])[parameter])


def _in_law(name: str, law: Law, value: float) -> float:
    """A parameter's value in the units of the law."""
    if name in ("rigidity", "damping"):
        return float(getattr(law, name) * value)
    if name in ("softness", "base_softness"):
        return 1.0 / value
    if name in ("half_gap", "phase"):
        return math.radians(value) / (2 if name == "half_gap" else 1)
    return float(value)


def turn(law: Law, motion: Motion, cells: Fineness = FINE) -> tuple[Array, Array]:
    """Tip angle, rad, and drive torque, N mm, on the fine grid, (N,) each.

    Raises:
      RuntimeError: no balance of torques was found at a time, which it names.
    """
    sheath = cells.sheath if law.sheath > 0 else 0
    mesh = Mesh(sheath + cells.inserted + 2, sheath, False)
    if motion.growing:
        mesh = Mesh(cells.needle + 1, 0, True)
    tip_torque = 0.0 if motion.tip_torque_n_mm is None else motion.tip_torque_n_mm
    drive = np.empty((5, motion.base_deg.size))
    drive[0], drive[1], drive[2] = np.radians(motion.base_deg), motion.inserted_mm, motion.free_mm
    drive[3], drive[4] = motion.speed_mm_s, tip_torque
    tip, torque, lost = march(law, mesh, motion.dt_s, drive)
    if lost >= 0:
        raise RuntimeError(f"no balance of torques was found at {lost * motion.dt_s} s with {law}")
    return np.asarray(tip), np.asarray(torque)


def observe(rig: Rig, motion: Motion, cells: Fineness = FINE) -> Trace:
    """What noise-free sensors show of the trial, on the fine grid."""
    tip, torque = turn(rig.law(), motion, cells)
    delay_s = rig.sensor("tip_sensor_delay", "delay")
    tip = np.interp(motion.time_s - delay_s, motion.time_s, np.degrees(tip))
    trace = Trace(
        time_s=motion.time_s,
        base_deg=motion.base_deg,
        torque_n_mm=torque + rig.sensor("torque_bias", "bias"),
        tip_deg=rig.sensor("tip_angle_scale", "scale") * tip + rig.sensor("tip_angle_bias", "bias"),
        speed_mm_s=motion.speed_mm_s,
    )
    for effect, parameters in rig.outside.items():
        trace = IN_SENSORS[effect](trace, parameters) if effect in IN_SENSORS else trace
    return trace
