"""The angle along the shaft at one time of a trial."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.prepare.prepared_log import PreparedLog
from diagnosis.replay.replay import shape_of
from diagnosis.replay.rig_parameters import RigParameters
from models import units
from sim.needles.run import Run

Array = NDArray[np.float64]

_ABOUT_S = 0.05


@dataclass(frozen=True, kw_only=True, eq=False)
class ShaftTwist:
    """Angles along the shaft at one time, by several rigs.

    Attributes:
      trial: name of the trial; `at_s`: time in it.
      free_mm, inserted_mm: length of the shaft before and in the tissue at that time.
      measured_tip_deg: reading of the tip sensor, averaged about that time; None: none.
      along: by rig, distance from the chuck in mm and angle in deg, (2, n + 1).
    """

    trial: str
    at_s: float
    free_mm: float
    inserted_mm: float
    measured_tip_deg: float | None
    along: dict[str, Array]


def shaft_twist(
    log: PreparedLog,
    trial: str,
    at_s: float,
    rigs: dict[str, RigParameters],
) -> ShaftTwist:
    """Simulate one trial with several rigs at the usual resolution; returns the shape of the shaft.

    Raises:
      SimulationFailed: one of the rigs cannot be simulated.
    """
    own = next(one for one in log.trials if one.name == trial)
    shapes = {
        name: _along(shape_of(log.rig, own, rig.on_trial(trial)), at_s) for name, rig in rigs.items()
    }
    return ShaftTwist(
        trial=trial,
        at_s=at_s,
        free_mm=float(np.interp(at_s, own.time_s, own.free_mm)),
        inserted_mm=float(np.interp(at_s, own.time_s, own.inserted_mm)),
        measured_tip_deg=_mean_about(own.time_s, own.readings.get("tip_angle_deg"), at_s),
        along=shapes,
    )


def _along(run: Run, at_s: float) -> Array:
    """Distance from the chuck, mm, and angle, deg, at the step nearest to a time, (2, n + 1)."""
    i = int(np.abs(run.time_s - at_s).argmin())
    nodes, stretching = run.setup.nodes_mm, run.setup.stretching
    if stretching:  # a mesh that stays with the tissue: the free length before it changes
        free, was = float(run.inputs.free_mm[i]), float(nodes[stretching])
        nodes = np.concatenate([nodes[:stretching] * free / was, nodes[stretching:] + free - was])
    assert run.angles_rad is not None
    return np.stack([nodes, run.angles_rad[i] / units.DEG])


def _mean_about(time_s: Array, readings: Array | None, at_s: float) -> float | None:
    """Mean of readings over a tenth of a second."""
    if readings is None:
        return None
    near = readings[np.abs(time_s - at_s) <= _ABOUT_S]
    near = near[np.isfinite(near)]
    return float(near.mean()) if near.size else None
