"""Free laws of a session: trials follow one another, and what happens in one stays for those after it.

- damping, dry friction, or the stiffness of the shaft, times a curve of the time since the first trial
  began: tissue that is warmed or dried, a needle that is
- the gain of a sensor, likewise: an amplifier that warms up
- damping times a curve of the turns since then: tissue that wears

The log does not tell how long the pauses between trials were: they are fitted, one length for all.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.interface import DAMPING
from diagnosis.freeform.families.readings import SENSOR
from diagnosis.freeform.family import VISCOUS, Family, Points, coordinates_of, most_probable
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, smooth_curve
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.sensing.variable_values import of_inputs
from diagnosis.replay.variables import UNITS, Variable
from models.tissue import Interface

Array = NDArray[np.float64]

FEWEST_TRIALS = 3
_PLACES = {Place.INTERFACE: 0.55, Place.TISSUE: 0.45}
_WORN = {Place.INTERFACE: 0.6, Place.TISSUE: 0.4}
_GAINS = {TIP: (ActsOn.TIP_GAIN, "tip"), TORQUE: (ActsOn.TORQUE_GAIN, "torque")}
_LEAST_SPAN = 1e-6  # of a trial that does not turn
_SHORTEST, _USUAL, _LONGEST = 0.01, 0.3, 10.0  # pause between trials, in their mean duration


@dataclass(frozen=True, kw_only=True, eq=False)
class Session:
    """A curve over the time, or the turns, of all trials, one after the other.

    Attributes:
      curve: over the share of the session.
      trials: their names.
      lasting: how long each lasts, or what it turns, (n,).
    """

    variable: Variable
    curve: SmoothCurve
    trials: tuple[str, ...]
    lasting: Array

    @property
    def pauses(self) -> tuple[Parameter, ...]:
        """The pause between trials; nothing turns meanwhile."""
        if self.variable is not Variable.TIME:
            return ()
        mean_s = float(self.lasting.mean())
        pause = Parameter(
            name="pause",
            unit="s",
            low=_SHORTEST * mean_s,
            high=_LONGEST * mean_s,
            start=(_USUAL * mean_s,),
            logarithmic=True,
            neutral=None,
        )
        return (pause,)

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """The pause, and the coordinates of the curve."""
        return (*self.pauses, *coordinates_of(self.curve))

    def split(self, values: Sequence[float]) -> tuple[float, Sequence[float]]:
        """The pause, and the coordinates."""
        return (values[0], values[1:]) if self.pauses else (0.0, values)

    def curves(self, values: Sequence[float], acts_on: ActsOn = ActsOn.TISSUE) -> tuple[Curve, ...]:
        """Factors in each trial, straight between the places of the curve."""
        pause, c = self.split(values)
        places, factors = self.length(pause) * self.curve.places, self.curve.factors(c)
        ends = np.cumsum(self.lasting) + pause * np.arange(self.lasting.size)
        return tuple(
            Curve(
                acts_on=acts_on,
                variable=self.variable,
                places=tuple(float(own) - begin for own in met),
                values=tuple(float(v) for v in np.interp(met, places, factors)),
                trial=name,
            )
            for name, end, own in zip(self.trials, ends, self.lasting, strict=True)
            for begin in [float(end - own)]
            for met in [_within(places, begin, float(end))]
        )

    def length(self, pause: float) -> float:
        """Of the whole session, with its pauses."""
        return float(self.lasting.sum()) + pause * (self.lasting.size - 1)


def _within(places: Array, begin: float, end: float) -> Array:
    inside = places[(places > begin) & (places < end)]
    return np.unique(np.concatenate([[begin], inside, [max(end, begin + _LEAST_SPAN)]]))


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The laws, if there are enough trials."""
    trials = ranges.problem.log.trials
    if len(trials) < FEWEST_TRIALS:
        return ()
    of_time = _session(Variable.TIME, trials)
    of_turns = [_session(Variable.HISTORY, trials)] if Variable.HISTORY in ranges.ends else []
    return (
        *(_damping(session, ranges) for session in (of_time, *of_turns)),
        _friction(of_time, ranges),
        _stiffness(of_time),
        *(_gain(of_time, sensor) for sensor in _GAINS if sensor in ranges.missing),
    )


def _session(variable: Variable, trials: Sequence[PreparedTrial]) -> Session:
    lasting = [
        float(of_inputs(variable, trial.schedule, float(trial.time_s[0]))[-1]) for trial in trials
    ]
    return Session(
        variable=variable,
        curve=smooth_curve(0.0, 1.0, min(2 * len(trials), 8)),
        trials=tuple(trial.name for trial in trials),
        lasting=np.array(lasting),
    )


def _damping(session: Session, ranges: LogRanges) -> Family:
    worn = session.variable is Variable.HISTORY
    places = _WORN if worn else DAMPING
    return Family(
        effect=Effect(
            name=f"damping over {session.variable}, of the session",
            title=f"damping that changes with the {'turns' if worn else 'time'} of all trials",
            place=most_probable(places),
            parameters=session.parameters,
            apply=partial(_apply_damping, session),
        ),
        places=places,
        says="history" if worn else "time",
        title="damping along the shaft",
        curve=partial(_points, session, ranges.damping_n_mm_s_per_mm),
        x_unit=f"{UNITS[session.variable]} of the session",
        unit=VISCOUS,
    )


def _apply_damping(session: Session, rig: RigParameters, *c: float) -> RigParameters:
    return replace(rig, free=FreeLaw(tissue_varies=True, curves=session.curves(c)))


def _friction(session: Session, ranges: LogRanges) -> Family:
    level = ranges.dry_level
    most = len(level.start)
    return Family(
        effect=Effect(
            name="dry friction over time, of the session",
            title="dry friction that changes with the time of all trials",
            place=Place.INTERFACE,
            parameters=(level, *(replace(p, start=most * p.start) for p in session.parameters)),
            apply=partial(_apply_friction, session),
            differences=(1e-2,),
        ),
        places=_PLACES,
        says="time",
        title="dry friction along the shaft",
        curve=partial(_points, session),
        x_unit="s of the session",
        unit="N mm / mm",
    )


def _apply_friction(session: Session, rig: RigParameters, level: float, *c: float) -> RigParameters:
    law = Interface(kinetic_n_mm_per_mm=level, varies=True)
    return replace(rig, free=FreeLaw(throughout=(law,), curves=session.curves(c)))


def _stiffness(session: Session) -> Family:
    return Family(
        effect=Effect(
            name="stiffness over time, of the session",
            title="stiffness of the shaft that changes with the time of all trials",
            place=Place.PARAMETERS,
            parameters=session.parameters,
            apply=partial(_apply_stiffness, session),
        ),
        places={Place.PARAMETERS: 0.6, Place.NEEDLE: 0.4},
        says="time",
        title="stiffness of the shaft over the nominal",
        curve=partial(_points, session, 1.0),
        x_unit="s of the session",
        unit="-",
    )


def _apply_stiffness(session: Session, rig: RigParameters, *c: float) -> RigParameters:
    curves = session.curves(c, ActsOn.STIFFNESS)
    return replace(rig, free=FreeLaw(tissue_varies=True, curves=curves))


def _gain(session: Session, sensor: str) -> Family:
    acts_on, what = _GAINS[sensor]
    return Family(
        effect=Effect(
            name=f"{what} gain over time, of the session",
            title=f"gain of the {what} sensor that changes with the time of all trials",
            place=Place.SENSOR,
            parameters=session.parameters,
            apply=partial(_apply_gain, session, acts_on),
        ),
        places=SENSOR,
        says="time",
        title=f"gain of the {what} sensor",
        curve=partial(_points, session, 1.0),
        x_unit="s of the session",
        unit="-",
    )


def _apply_gain(session: Session, acts_on: ActsOn, rig: RigParameters, *c: float) -> RigParameters:
    return replace(rig, free=FreeLaw(curves=session.curves(c, acts_on)))


def _points(session: Session, size: float, *values: float) -> Points:
    pause, c = session.split(values)
    return session.length(pause) * session.curve.places, size * np.array(session.curve.factors(c))
