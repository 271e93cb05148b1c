"""The stages of `needle control` on steering, in order."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

from studies.control.steering import planar_study
from studies.control.steering.duty_cycle_study import SpunCurvature, spun_curvatures
from studies.control.steering.fused_study import RollErrors, compare_estimators
from studies.control.steering.planar_study import PlaneApproach, approach_plane, imaged_approaches
from studies.control.steering.steered_insertions import SteeredInsertion, TurnOrder, steered_insertions


@dataclass(frozen=True, kw_only=True)
class SteeringStudy:
    """All results of steering.

    Attributes:
      steered: Figs. 11 and 12, by the order of the half turns.
      known_pose: the planar controller with known pose, by speed, mm/s.
      imaged: with images, by speed, mm/s, and case: one approach per seed.
      fused: errors of the roll by plant and estimator.
      spun: curvatures under duty-cycled spinning.
    """

    steered: dict[TurnOrder, list[SteeredInsertion]]
    known_pose: dict[float, list[PlaneApproach]]
    imaged: dict[float, dict[str, list[PlaneApproach]]]
    fused: dict[str, dict[str, RollErrors]]
    spun: list[SpunCurvature]

    @classmethod
    def of_parts(
        cls,
        steered: list[list[SteeredInsertion]],
        known_pose: list[list[PlaneApproach]],
        imaged: list[dict[str, list[PlaneApproach]]],
        fused: list[dict[str, dict[str, RollErrors]]],
        spun: list[list[SpunCurvature]],
    ) -> "SteeringStudy":
        """The study made of the results of all parts, in the order of `steering_parts`."""
        speeds = planar_study.SPEEDS_MM_S
        return cls(
            steered=dict(zip(TurnOrder, steered, strict=True)),
            known_pose=dict(zip(speeds, known_pose, strict=True)),
            imaged=dict(zip(speeds, imaged, strict=True)),
            fused=fused[0],
            spun=spun[0],
        )


def steering_parts() -> dict[str, list[Callable[[], Any]]]:
    """The independent parts of every stage on steering, in order."""
    speeds = planar_study.SPEEDS_MM_S
    return {
        "steered insertions": [partial(steered_insertions, order) for order in TurnOrder],
        "the planar controller": [partial(approach_plane, speed_mm_s=speed) for speed in speeds],
        "the planar controller with images": [
            partial(imaged_approaches, speed_mm_s=speed) for speed in speeds
        ],
        "base and images fused": [compare_estimators],
        "duty-cycled spinning": [spun_curvatures],
    }
