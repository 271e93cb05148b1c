"""Every stage of `needle control`."""

from collections.abc import Callable

from studies.control.report import ControlStudy
from studies.control.robustness import robustness
from studies.control.steering.steering_study import STEERING_STAGES, run_steering
from studies.control.tables import tables_iv_v

STAGES = ("Tables IV and V", "robustness", *STEERING_STAGES)


def run_study(progress: Callable[[str], None] = lambda stage: None) -> ControlStudy:
    """Run everything; about two minutes.

    Args:
      progress: called with the name of each stage as it begins.
    """
    progress(STAGES[0])
    iv_v = tables_iv_v()
    progress(STAGES[1])
    robust = robustness()
    steering = run_steering(progress)
    return ControlStudy(tables=iv_v, robustness=robust, steering=steering)
