"""Everything that `needle control` runs, stage by stage."""

from collections.abc import Callable

from sim.control.report import ControlStudy
from sim.control.steering import hold_plane, insert_straight
from sim.control.tables import robustness, tables

PLANAR_SPEEDS_MM_S = (5.0, 7.5, 10.0)
STAGES = ("Tables IV and V", "robustness", "steered insertions", "the planar controller")


def run_study(progress: Callable[[str], None] = lambda stage: None) -> ControlStudy:
    """Run everything; about a minute.

    Args:
      progress: called with the name of each stage as it begins.
    """
    progress(STAGES[0])
    iv_v = tables()
    progress(STAGES[1])
    robust = robustness()
    progress(STAGES[2])
    steered = insert_straight()
    progress(STAGES[3])
    planes = {speed: hold_plane(speed_mm_s=speed) for speed in PLANAR_SPEEDS_MM_S}
    return ControlStudy(tables=iv_v, robustness=robust, steered=steered, planes=planes)
