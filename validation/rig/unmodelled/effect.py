"""An effect outside the diagnosis' models: what it changes, where it acts and what it depends on."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from validation.rig.laws.parameters import LawParameters
from validation.rig.motion import TrialMotion

Array = NDArray[np.float64]
Parameters = Mapping[str, float]

PLACES = ("interface", "tissue", "drive", "needle", "sensor", "parameters")
VARIABLES = (
    *("time", "event", "base_angle", "tip_angle", "rate", "direction", "axial_speed", "depth"),
    *("torque", "position", "history"),
)
"""`event`: something happened once; `depth` is the inserted length, `position` is along the shaft."""


@dataclass(frozen=True, kw_only=True)
class IdealSignals:
    """Ideal signals of a trial on its fine time grid, (N,) each; `trial` as in `TrialMotion`."""

    time_s: Array
    base_deg: Array
    torque_n_mm: Array
    tip_deg: Array
    speed_mm_s: Array
    trial: int = 0


ChangedLaw = Callable[[LawParameters, Parameters], LawParameters]
ChangedDrive = Callable[[TrialMotion, Parameters], Array]
ChangedSignals = Callable[[IdealSignals, Parameters], IdealSignals]


@dataclass(frozen=True, kw_only=True)
class UnmodelledEffect:
    """An effect that the diagnosis does not model; one of `law`, `drive` and `signals` applies it.

    Attributes:
      place: where it acts; several are right if no log could tell one from the other.
      variables: what it depends on, some of `VARIABLES`: the leading one, then equally right ones.
      law: changes parameters of the laws.
      drive: angle of the chuck, deg, (N,), for a drive shaft that turns as the motion says.
      signals: changes what sensors show.
    """

    place: tuple[str, ...]
    variables: tuple[str, ...]
    law: ChangedLaw | None = None
    drive: ChangedDrive | None = None
    signals: ChangedSignals | None = None


def once(time_s: Array, trial: int, p: Parameters) -> Array:
    """0 before and 1 after the event of trial `trial`, at that share of its time, (N,)."""
    if trial != p["trial"]:
        return np.zeros_like(time_s)
    return np.asarray(time_s > p["share"] * time_s[-1], dtype=float)
