"""Free laws of a session: trials follow one another, and what happens in one stays for those after it.

- damping, dry friction, or the stiffness of the shaft, times a curve of the time since the first trial
  began: tissue that is warmed or dried, a needle that is
- damping times a curve of the turns since then: tissue that wears

The log does not tell how long the pauses between trials were: they count as nothing.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Effect, Place
from diagnosis.freeform.family import Family, Points, coordinates_of
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, smooth_curve
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.replay.free_law import ActsOn, Curve, FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import UNITS, Variable, of_inputs
from models.tissue import Interface

Array = NDArray[np.float64]

FEWEST_TRIALS = 3
_PLACES = {Place.TISSUE: 0.6, Place.INTERFACE: 0.4}
_WORN = {Place.INTERFACE: 0.6, Place.TISSUE: 0.4}
_LEAST_SPAN = 1e-6  # of a trial that does not turn


@dataclass(frozen=True, kw_only=True, eq=False)
class Session:
    """A curve over the time, or the turns, of all trials, one after the other.

    Attributes:
      spans: by trial, where it begins and ends.
    """

    variable: Variable
    curve: SmoothCurve
    spans: tuple[tuple[str, float, float], ...]

    def curves(self, c: Sequence[float], acts_on: ActsOn = ActsOn.TISSUE) -> tuple[Curve, ...]:
        """Factors in each trial, straight between the places of the curve."""
        return tuple(
            Curve(
                acts_on=acts_on,
                variable=self.variable,
                places=tuple(float(own) - begin for own in places),
                values=tuple(float(v) for v in np.interp(places, self.curve.places, factors)),
                trial=name,
            )
            for factors in [self.curve.factors(c)]
            for name, begin, end in self.spans
            for places in [self._places(begin, end)]
        )

    def _places(self, begin: float, end: float) -> Array:
        inside = self.curve.places[(self.curve.places > begin) & (self.curve.places < end)]
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
    )


def _session(variable: Variable, trials: Sequence[PreparedTrial]) -> Session:
    lasting = [
        float(of_inputs(variable, trial.schedule, float(trial.time_s[0]))[-1]) for trial in trials
    ]
    ends = np.cumsum(lasting)
    spans = zip([t.name for t in trials], ends - lasting, ends, strict=True)
    return Session(
        variable=variable,
        curve=smooth_curve(0.0, float(ends[-1]), min(2 * len(trials), 8)),
        spans=tuple((name, float(begin), float(end)) for name, begin, end in spans),
    )


def _damping(session: Session, ranges: LogRanges) -> Family:
    worn = session.variable is Variable.HISTORY
    places = _WORN if worn else _PLACES
    return Family(
        effect=Effect(
            name=f"damping over {session.variable}, of the session",
            title=f"damping that changes with the {'turns' if worn else 'time'} of all trials",
            place=max(places, key=lambda place: places[place]),
            parameters=coordinates_of(session.curve),
            apply=partial(_apply_damping, session),
        ),
        places=places,
        says="history" if worn else "time",
        title="damping along the shaft",
        curve=partial(_points, session, ranges.damping_n_mm_s_per_mm),
        x_unit=f"{UNITS[session.variable]} of all trials",
        unit="N mm s / rad / mm",
    )


def _apply_damping(session: Session, rig: RigParameters, *c: float) -> RigParameters:
    return replace(rig, free=FreeLaw(tissue_varies=True, curves=session.curves(c)))


def _friction(session: Session, ranges: LogRanges) -> Family:
    level = ranges.library["coulomb_friction"].parameters[0]
    neutral = (0.0,) * len(level.start)
    return Family(
        effect=Effect(
            name="dry friction over time, of the session",
            title="dry friction that changes with the time of all trials",
            place=Place.TISSUE,
            parameters=(level, *(replace(p, start=neutral) for p in coordinates_of(session.curve))),
            apply=partial(_apply_friction, session),
            differences=(1e-2,),
        ),
        places=_PLACES,
        says="time",
        title="dry friction along the shaft",
        curve=partial(_points, session),
        x_unit="s of all trials",
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
            parameters=coordinates_of(session.curve),
            apply=partial(_apply_stiffness, session),
        ),
        places={Place.PARAMETERS: 0.6, Place.NEEDLE: 0.4},
        says="time",
        title="stiffness of the shaft over the nominal",
        curve=partial(_points, session, 1.0),
        x_unit="s of all trials",
        unit="-",
    )


def _apply_stiffness(session: Session, rig: RigParameters, *c: float) -> RigParameters:
    curves = session.curves(c, ActsOn.STIFFNESS)
    return replace(rig, free=FreeLaw(tissue_varies=True, curves=curves))


def _points(session: Session, size: float, *c: float) -> Points:
    return session.curve.places, size * np.array(session.curve.factors(c))
