"""Computing time of a Jacobian of a fit: with MuJoCo's steps, and with the callback alone.

The values at the end of a fit are MuJoCo's. Its iterations and slopes use the callback's own steps,
which end where MuJoCo's do (`sim.needles.callback_loop`).
For effects that change the needle: one Jacobian of each, with the nuisance parameters, both ways, on the
decimated log and on the log itself; the ratio of times, and the difference of the columns / their
norm. Both ways alternate in one run: the ratio is the result.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks import report
from benchmarks.diagnosis import SHORT, SINGLE, write_log
from diagnosis.fitting.decimation import decimated
from diagnosis.fitting.parameterization import starts
from diagnosis.fitting.problem import FitProblem
from diagnosis.log.rig_log import read_rig_log
from diagnosis.pipeline import replay_nominal
from sim.simulation import prepare_processes

Array = NDArray[np.float64]

RATIO_BOUND = 1.5  # median over effects, on the log itself
APART_BOUND = 1e-6  # of slopes; the truncation of their differences is some 1e-3 of them

SHOWN = (
    *("damping_error", "layered_tissue", "coulomb_friction", "stiction", "shear_thinning"),
    *("tissue_viscoelasticity", "chuck_backlash", "base_compliance", "sheath_friction"),
    *("entry_friction", "needle_curvature", "tip_drag", "inserted_offset"),
)
"""Effects that change the needle; those of sensors alone need no other run."""

_DIFFERENCE = 1e-3
_TURNS = 5


@dataclass(frozen=True, kw_only=True)
class Columns:
    """The Jacobian of one effect.

    Attributes:
      mujoco_s, callback_s: CPU time either way.
      apart: norm of their difference over that of the first.
    """

    log: str
    effect: str
    count: int
    mujoco_s: float
    callback_s: float
    apart: float

    @property
    def ratio(self) -> float:
        """Time with MuJoCo / time with the callback alone."""
        return self.mujoco_s / self.callback_s


def columns(problem: FitProblem, name: str, log: str) -> Columns:
    """The Jacobian of an effect at its first start, both ways."""
    parameterization = problem.parameterization((name,))
    x = parameterization.joined({name: starts(problem.library[name])[0]})
    rigs = [parameterization.rig(x + step) for step in _DIFFERENCE * np.eye(x.size)]
    here = np.concatenate([trial[0] for trial in problem.residuals([parameterization.rig(x)])])

    def slopes(*, callback_alone: bool) -> Array:
        trials = problem.residuals(rigs, callback_alone=callback_alone)
        moved = [np.concatenate([trial[i] for trial in trials]) for i in range(x.size)]
        return (np.stack(moved, axis=-1) - here[:, None]) / _DIFFERENCE

    ways: dict[bool, Callable[[], object]] = {
        alone: lambda alone=alone: slopes(callback_alone=alone) for alone in (False, True)
    }
    taken = report.least_times_s(ways, turns=_TURNS)
    mujoco, alone = slopes(callback_alone=False), slopes(callback_alone=True)
    return Columns(
        log=log,
        effect=name,
        count=x.size,
        mujoco_s=taken[False],
        callback_s=taken[True],
        apart=float(np.linalg.norm(alone - mujoco) / np.linalg.norm(mujoco)),
    )


def _row(one: Columns) -> dict[str, Any]:
    return {
        "log": one.log,
        "effect": one.effect,
        "columns": one.count,
        "MuJoCo, ms": 1e3 * one.mujoco_s,
        "callback alone, ms": 1e3 * one.callback_s,
        "ratio": one.ratio,
        "apart, of norm": one.apart,
    }


def run(folder: Path) -> list[report.Goal]:
    """Measure, print, write."""
    prepare_processes()
    nominal = replay_nominal(read_rig_log(write_log(folder / "fit-log", SHORT, SINGLE)))
    fine = nominal.problem
    problems = {"decimated": decimated(fine, nominal.predictions), "itself": fine}
    every = [columns(p, name, log) for log, p in problems.items() for name in SHOWN]
    rows = [_row(one) for one in every]
    report.show("One Jacobian, with MuJoCo and by the callback alone", rows, folder, "fit_columns")
    ratio = float(np.median([one.ratio for one in every if one.log == "itself"]))
    apart = max(one.apart for one in every)
    return [
        report.Goal(
            name="Jacobian: MuJoCo over callback", measured=ratio, bound=RATIO_BOUND, at_least=True
        ),
        report.Goal(name="Jacobian: largest difference", measured=apart, bound=APART_BOUND),
    ]


if __name__ == "__main__":
    folder_ = report.out_folder(report.parser(__doc__))
    report.show_goals(run(folder_), folder_)
