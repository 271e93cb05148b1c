"""What real rigs also do, and the vocabulary lacks. Some change the law, some what sensors show.

Each has a law, in a docstring, and parameters, of which one, its strength, may be made as small as
one likes. None is exactly an effect of the vocabulary, but weak ones may look much like one.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from validation.rig.laws import Law

Array = NDArray[np.float64]
Parameters = Mapping[str, float]


@dataclass(frozen=True, kw_only=True)
class Trace:
    """Ideal signals of a trial on its fine time grid, (N,) each."""

    time_s: Array
    base_deg: Array
    torque_n_mm: Array
    tip_deg: Array
    speed_mm_s: Array

    def but(self, **changes: Array) -> "Trace":
        """A copy with some signals changed."""
        return Trace(**{**vars(self), **changes})


def hardening_shaft(law: Law, p: Parameters) -> Law:
    """Torque of the shaft is rigidity * strain (1 + coefficient strain^2), strain in rad/mm."""
    return law._replace(hardening=p["coefficient"])


def lubrication(law: Law, p: Parameters) -> Law:
    """Damping falls by `share` as the shaft slips: 1 - share (1 - exp(-travelled angle / angle))."""
    return law._replace(worn_share=p["share"], worn_angle=np.radians(p["angle"]))


def one_way_friction(law: Law, p: Parameters) -> Law:
    """Dry friction of level (1 + asymmetry) for positive slip, (1 - asymmetry) for negative."""
    return law._replace(coulomb=p["level"], asymmetry=p["asymmetry"])


def damping_gradient(law: Law, p: Parameters) -> Law:
    """Damping grows evenly along the inserted shaft from 1 - gradient to 1 + gradient of its mean."""
    return law._replace(gradient=p["gradient"])


def slipping_chuck(law: Law, p: Parameters) -> Law:
    """The chuck slips where its torque would exceed `torque`, and keeps it."""
    return law._replace(grip=p["torque"])


def friction_ageing(law: Law, p: Parameters) -> Law:
    """Dry friction that grows with rest: level + growth log(1 + age / time).

    The age is that of the contact: it rises with time and is renewed by slip over `angle`.
    """
    return law._replace(
        coulomb=p["level"],
        ageing=p["growth"],
        ageing_time=p["time"],
        ageing_angle=np.radians(p["angle"]),
    )


def tip_sensor_lag(trace: Trace, p: Parameters) -> Trace:
    """The tip sensor is a first-order low pass: time_constant * d(shown)/dt = tip - shown."""
    decay = np.exp(-trace.time_s[1] / p["time_constant"])
    shown = trace.tip_deg.copy()
    ramp = p["time_constant"] / trace.time_s[1] * (1 - decay)
    for i in range(1, shown.size):  # exact for a tip that runs straight within the step
        before, after = trace.tip_deg[i - 1], trace.tip_deg[i]
        shown[i] = decay * shown[i - 1] + (ramp - decay) * before + (1 - ramp) * after
    return trace.but(tip_deg=shown)


def torque_drift(trace: Trace, p: Parameters) -> Trace:
    """The torque sensor drifts linearly in time, `rate` N mm / s, from zero in each trial."""
    return trace.but(torque_n_mm=trace.torque_n_mm + p["rate"] * trace.time_s)


def torque_ripple(trace: Trace, p: Parameters) -> Trace:
    """Cogging of the drive: amplitude sin(teeth * base angle + phase) on the torque."""
    ripple = np.sin(np.radians(p["teeth"] * trace.base_deg + p["phase"]))
    return trace.but(torque_n_mm=trace.torque_n_mm + p["amplitude"] * ripple)


def tip_sensor_cubic(trace: Trace, p: Parameters) -> Trace:
    """The tip sensor shows tip + cubic * (tip / 180 deg)^3."""
    return trace.but(tip_deg=trace.tip_deg + p["cubic"] * (trace.tip_deg / 180) ** 3)


def tip_sensor_periodic(trace: Trace, p: Parameters) -> Trace:
    """The tip sensor errs with the orientation: tip + amplitude sin(cycles * tip + phase)."""
    error = np.sin(np.radians(p["cycles"] * trace.tip_deg + p["phase"]))
    return trace.but(tip_deg=trace.tip_deg + p["amplitude"] * error)


def eccentric_encoder(trace: Trace, p: Parameters) -> Trace:
    """The shown base angle errs once per turn: base + amplitude (sin(base + phase) - sin(phase))."""
    error = np.sin(np.radians(trace.base_deg + p["phase"])) - np.sin(np.radians(p["phase"]))
    return trace.but(base_deg=trace.base_deg + p["amplitude"] * error)


def axial_crosstalk(trace: Trace, p: Parameters) -> Trace:
    """The torque sensor also feels the axial motion: torque + gain * speed."""
    return trace.but(torque_n_mm=trace.torque_n_mm + p["gain"] * trace.speed_mm_s)


IN_LAW: dict[str, Callable[[Law, Parameters], Law]] = {
    "hardening_shaft": hardening_shaft,
    "lubrication": lubrication,
    "one_way_friction": one_way_friction,
    "damping_gradient": damping_gradient,
    "slipping_chuck": slipping_chuck,
    "friction_ageing": friction_ageing,
}
IN_SENSORS: dict[str, Callable[[Trace, Parameters], Trace]] = {
    "tip_sensor_lag": tip_sensor_lag,
    "torque_drift": torque_drift,
    "torque_ripple": torque_ripple,
    "tip_sensor_cubic": tip_sensor_cubic,
    "tip_sensor_periodic": tip_sensor_periodic,
    "eccentric_encoder": eccentric_encoder,
    "axial_crosstalk": axial_crosstalk,
}
OUTSIDE = (*IN_LAW, *IN_SENSORS)
