"""What a diagnosis says of the sensors: what they do beside noise, and what was done about it."""

from collections.abc import Sequence

from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.effects import IMPERFECTIONS
from diagnosis.in_sigma import in_sigma
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.sensing.reading_errors import ClockStart, ReadingJump
from diagnosis.result import Diagnosis

_SENSORS = {TORQUE: "the torque sensor", TIP: "the tip sensor"}
_UNITS = {TORQUE: "N mm", TIP: "deg"}


def imperfections(found: Diagnosis) -> str:
    """What the sensors do beside noise, in one sentence; empty where nothing had to be allowed for."""
    said = told_of_sensors(found)
    return f"The sensors are not perfect; the diagnosis allows for this: {said}" if said else ""


def told_of_sensors(found: Diagnosis) -> str:
    """What the sensors do beside noise, as phrases; empty where nothing had to be allowed for."""
    errors = found.assessment.sensors
    lines = [_told(name, parameters) for name, parameters in errors.imperfections.items()]
    lines += [_ran(sensor, errors.clock_starts) for sensor in _SENSORS]
    lines += [
        f"a drift of {_SENSORS[sensor]}, by up to {in_sigma(most)} "
        f"({most * found.noise[sensor]:.2g} {_UNITS[sensor]}) within a trial"
        for sensor, most in errors.drift_sigma.items()
        if most > 0.0
    ]
    lines += map(_jumped, errors.reading_jumps)
    return "; ".join(filter(None, lines))


def _ran(sensor: str, clocks: Sequence[ClockStart]) -> str:
    """For how long the clock of a sensor ran before the trials; empty: it began with them."""
    each = [f"{one.before_s:.3g} s before {one.trial}" for one in clocks if one.sensor == sensor]
    return f"the clock of {_SENSORS[sensor]} ran for {', '.join(each)}" if each else ""


def _jumped(jump: ReadingJump) -> str:
    why = "its zero had shifted" if jump.sensor == TORQUE else "counts were lost"
    return (
        f"a jump of {jump.sensor} by {jump.size:+.3g} {jump.unit} at {jump.time_s:g} s in {jump.trial}, "
        f"which stays, as if {why}"
    )


def _told(name: str, parameters: dict[str, Interval]) -> str:
    effect = IMPERFECTIONS[name]
    values = [
        f"{p} {own.value:.3g} (95 % interval {own.low:.3g} to {own.high:.3g}) {own.unit}"
        for p, own in parameters.items()
    ]
    return f"{effect.title}, {', '.join(values).removesuffix(' -')}"
