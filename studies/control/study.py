"""Every stage of `needle control`."""

from collections.abc import Callable

from studies.control.report import ControlStudy
from studies.control.robustness import robustness
from studies.control.steering import approach_plane, steered_insertions
from studies.control.tables import tables_iv_v

PLANAR_SPEEDS_MM_S = (5.0, 7.5, 10.0)
STAGES = ("Tables IV and V", "robustness", "steered insertions", "the planar controller")


def run_study(progress: Callable[[str], None] = lambda stage: None) -> ControlStudy:
    """Run everything; about a minute.

    Args:
      progress: called with the name of each stage as it begins.
    """
    progress(STAGES[0])
    iv_v = tables_iv_v()
    progress(STAGES[1])
    robust = robustness()
    progress(STAGES[2])
    steered = steered_insertions()
    progress(STAGES[3])
    planes = {speed: approach_plane(speed_mm_s=speed) for speed in PLANAR_SPEEDS_MM_S}
    return ControlStudy(tables=iv_v, robustness=robust, steered=steered, planes=planes)
