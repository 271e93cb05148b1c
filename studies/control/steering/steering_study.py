"""The stages of `needle control` that steer: what they compute, in order."""

from collections.abc import Callable
from dataclasses import dataclass

from studies.control.steering import planar_study
from studies.control.steering.duty_cycle_study import SpunCurvature, spun_curvatures
from studies.control.steering.fused_study import RollErrors, compare_estimators
from studies.control.steering.planar_study import PlaneApproach, approach_plane, imaged_approaches
from studies.control.steering.steered_insertions import SteeredInsertion, TurnOrder, steered_insertions

STEERING_STAGES = (
    "steered insertions",
    "the planar controller",
    "the planar controller with images",
    "base and images fused",
    "duty-cycled spinning",
)


@dataclass(frozen=True, kw_only=True)
class SteeringStudy:
    """All results of steering.

    Attributes:
      steered: Figs. 11 and 12, by the order of the half turns.
      known_pose: the planar controller without images, by speed, mm/s.
      imaged: with images, by speed, mm/s, and case: an approach for each seed.
      fused: errors of the roll by plant and estimator.
      spun: curvatures under duty-cycled spinning.
    """

    steered: dict[TurnOrder, list[SteeredInsertion]]
    known_pose: dict[float, list[PlaneApproach]]
    imaged: dict[float, dict[str, list[PlaneApproach]]]
    fused: dict[str, dict[str, RollErrors]]
    spun: list[SpunCurvature]


def run_steering(progress: Callable[[str], None]) -> SteeringStudy:
    """Run everything that steers.

    Args:
      progress: called with the name of each stage as it begins.
    """
    speeds = planar_study.SPEEDS_MM_S
    progress(STEERING_STAGES[0])
    steered = {order: steered_insertions(order) for order in TurnOrder}
    progress(STEERING_STAGES[1])
    known_pose = {speed: approach_plane(speed_mm_s=speed) for speed in speeds}
    progress(STEERING_STAGES[2])
    imaged = {speed: imaged_approaches(speed_mm_s=speed) for speed in speeds}
    progress(STEERING_STAGES[3])
    fused = compare_estimators()
    progress(STEERING_STAGES[4])
    spun = spun_curvatures()
    return SteeringStudy(steered=steered, known_pose=known_pose, imaged=imaged, fused=fused, spun=spun)
