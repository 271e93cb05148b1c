"""What one sample of the control loop costs: estimator and controller, at 1 kHz.

Every tip controller is fed the samples of a fast turn; the cost is the least of several
passes over them, so that a planning sample of the least-time controller is given
apart: it plans once a step of the reference, outside the loop's budget.
"""

import time
from pathlib import Path

import numpy as np

from benchmarks import report
from models.needle import NITINOL
from sim.closed_loop import Measurement
from sim.discretisation import Discretisation
from sim.experiment import perform
from sim.paper_protocols import protocol_named
from studies.control.step_response import DAMPING
from studies.control.tip_controllers import TIP_CONTROLLERS, ControllerDesign, tip_controller_named

BOUND_US = 50.0
_PASSES = 5
_RATE_HZ = 1000.0


def readings() -> list[Measurement]:
    """A turn of 90 deg at 10 cm, sampled at 1 kHz, with the needle sliding."""
    turn = protocol_named("fig5-10cm").but(
        tissue="viscous-plastisol", discretisation=Discretisation(step_s=1 / _RATE_HZ)
    )
    run = perform(turn)
    columns = ("time_s", "base_angle_deg", "base_torque_n_mm", "tip_angle_deg", "inserted_mm", "free_mm")
    names = ("time_s", "base_deg", "torque_n_mm", "tip_deg", "inserted_mm", "free_mm")
    rows = zip(*(run[c] for c in columns), strict=True)
    return [Measurement(**dict(zip(names, row, strict=True))) for row in rows]


def cost_us(name: str, samples: list[Measurement]) -> tuple[float, float]:
    """Median and largest cost of a sample, us, at best of several passes."""
    passes = []
    for _ in range(_PASSES):
        controller = tip_controller_named(
            name, ControllerDesign(needle=NITINOL, damping_n_mm_s_per_mm=DAMPING)
        )
        costs = []
        for reading in samples:
            start = time.perf_counter()
            controller(reading, 90.0 if reading.time_s > 1.0 else 0.0)
            costs.append(1e6 * (time.perf_counter() - start))
        passes.append(costs)
    least = np.min(passes, axis=0)
    return float(np.median(least)), float(least.max())


def run(folder: Path) -> list[report.Goal]:
    """Measure, print, write."""
    samples = readings()
    rows, goals = [], []
    for name in TIP_CONTROLLERS:
        median, largest = cost_us(name, samples)
        rows.append({"controller": name, "median, us": median, "largest, us": largest})
        goals.append(report.Goal(name=f"a sample of {name}", measured=median, bound=BOUND_US, unit="us"))
    report.show("One sample of a control loop at 1 kHz", rows, folder, "control_loop")
    return goals


if __name__ == "__main__":
    folder_ = report.out_folder(report.parser(__doc__))
    report.show_goals(run(folder_), folder_)
