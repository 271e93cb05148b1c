"""What real rigs also do and the diagnosis does not model: changes of a law or of a sensor.

Each has a law, in a docstring, and parameters, of which one, its strength, may be made as small as
one likes. None is exactly a modelled effect, but weak ones may look much like one.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from validation.rig.laws import LawParameters

Array = NDArray[np.float64]
Parameters = Mapping[str, float]


@dataclass(frozen=True, kw_only=True)
class IdealSignals:
    """Ideal signals of a trial on its fine time grid, (N,) each."""

    time_s: Array
    base_deg: Array
    torque_n_mm: Array
    tip_deg: Array
    speed_mm_s: Array


def hardening_shaft(law: LawParameters, p: Parameters) -> LawParameters:
    """Torque of the shaft is rigidity * strain (1 + coefficient strain^2), strain in rad/mm."""
    return law._replace(hardening=p["coefficient"])


def lubrication(law: LawParameters, p: Parameters) -> LawParameters:
    """Damping falls by `share` as the shaft slips: 1 - share (1 - exp(-travelled angle / angle))."""
    return law._replace(worn_share=p["share"], worn_angle=np.radians(p["angle"]))


def one_way_friction(law: LawParameters, p: Parameters) -> LawParameters:
    """Dry friction of level (1 + asymmetry) for positive slip, (1 - asymmetry) for negative."""
    return law._replace(coulomb=p["level"], asymmetry=p["asymmetry"])


def damping_gradient(law: LawParameters, p: Parameters) -> LawParameters:
    """Damping grows evenly along the inserted shaft from 1 - gradient to 1 + gradient of its mean."""
    return law._replace(gradient=p["gradient"])


def slipping_chuck(law: LawParameters, p: Parameters) -> LawParameters:
    """The chuck slips where its torque would exceed `torque`, and keeps it."""
    return law._replace(grip=p["torque"])


def friction_ageing(law: LawParameters, p: Parameters) -> LawParameters:
    """Dry friction that grows with rest: level + growth log(1 + age / time).

    The age is that of the contact: it rises with time and is renewed by slip over `angle`.
    """
    return law._replace(
        coulomb=p["level"],
        ageing=p["growth"],
        ageing_time=p["time"],
        ageing_angle=np.radians(p["angle"]),
    )


def tip_sensor_lag(signals: IdealSignals, p: Parameters) -> IdealSignals:
    """The tip sensor is a first-order low pass: time_constant * d(shown)/dt = tip - shown."""
    shown = low_passed(signals.tip_deg, float(signals.time_s[1]), p["time_constant"])
    return replace(signals, tip_deg=shown)


def low_passed(values: Array, dt_s: float, time_constant_s: float) -> Array:
    """First order, settled at the first value; exact for values that run straight within each step."""
    decay = np.exp(-dt_s / time_constant_s)
    shown = values.copy()
    ramp = time_constant_s / dt_s * (1 - decay)
    for i in range(1, shown.size):
        before, after = values[i - 1], values[i]
        shown[i] = decay * shown[i - 1] + (ramp - decay) * before + (1 - ramp) * after
    return shown


def torque_drift(signals: IdealSignals, p: Parameters) -> IdealSignals:
    """The torque sensor drifts linearly in time, `rate` N mm / s, from zero in each trial."""
    return replace(signals, torque_n_mm=signals.torque_n_mm + p["rate"] * signals.time_s)


def torque_ripple(signals: IdealSignals, p: Parameters) -> IdealSignals:
    """Cogging of the drive: amplitude sin(teeth * base angle + phase) on the torque."""
    ripple = np.sin(np.radians(p["teeth"] * signals.base_deg + p["phase"]))
    return replace(signals, torque_n_mm=signals.torque_n_mm + p["amplitude"] * ripple)


def tip_sensor_cubic(signals: IdealSignals, p: Parameters) -> IdealSignals:
    """The tip sensor shows tip + cubic * (tip / 180 deg)^3."""
    return replace(signals, tip_deg=signals.tip_deg + p["cubic"] * (signals.tip_deg / 180) ** 3)


def tip_sensor_periodic(signals: IdealSignals, p: Parameters) -> IdealSignals:
    """The tip sensor errs with the orientation: tip + amplitude sin(cycles * tip + phase)."""
    error = np.sin(np.radians(p["cycles"] * signals.tip_deg + p["phase"]))
    return replace(signals, tip_deg=signals.tip_deg + p["amplitude"] * error)


def eccentric_encoder(signals: IdealSignals, p: Parameters) -> IdealSignals:
    """The shown base angle errs once per turn: base + amplitude (sin(base + phase) - sin(phase))."""
    error = np.sin(np.radians(signals.base_deg + p["phase"])) - np.sin(np.radians(p["phase"]))
    return replace(signals, base_deg=signals.base_deg + p["amplitude"] * error)


def axial_crosstalk(signals: IdealSignals, p: Parameters) -> IdealSignals:
    """The torque sensor also feels the axial motion: torque + gain * speed."""
    return replace(signals, torque_n_mm=signals.torque_n_mm + p["gain"] * signals.speed_mm_s)


LAW_EFFECTS: dict[str, Callable[[LawParameters, Parameters], LawParameters]] = {
    "hardening_shaft": hardening_shaft,
    "lubrication": lubrication,
    "one_way_friction": one_way_friction,
    "damping_gradient": damping_gradient,
    "slipping_chuck": slipping_chuck,
    "friction_ageing": friction_ageing,
}
SENSOR_EFFECTS: dict[str, Callable[[IdealSignals, Parameters], IdealSignals]] = {
    "tip_sensor_lag": tip_sensor_lag,
    "torque_drift": torque_drift,
    "torque_ripple": torque_ripple,
    "tip_sensor_cubic": tip_sensor_cubic,
    "tip_sensor_periodic": tip_sensor_periodic,
    "eccentric_encoder": eccentric_encoder,
    "axial_crosstalk": axial_crosstalk,
}
UNMODELLED = (*LAW_EFFECTS, *SENSOR_EFFECTS)
UNLISTED = ("free_length_error", "diameter_error")
"""Wrong constants that no effect is named after: `offset`, true less logged free length, mm; `share`, by
which the needle is thicker than stated."""
