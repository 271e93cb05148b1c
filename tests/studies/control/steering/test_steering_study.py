"""The parts of steering, and the study that they make."""

from studies.control.steering import planar_study, steering_study
from studies.control.steering.steered_insertions import TurnOrder
from studies.control.steering.steering_study import SteeringStudy, steering_parts


def test_what_every_part_returns_is_kept_under_its_speed_or_order(monkeypatch):
    """The parts themselves have tests of their own."""
    monkeypatch.setattr(steering_study, "steered_insertions", lambda order: [order])
    monkeypatch.setattr(steering_study, "approach_plane", lambda speed_mm_s: ["pose", speed_mm_s])
    monkeypatch.setattr(steering_study, "imaged_approaches", lambda speed_mm_s: {"case": speed_mm_s})
    monkeypatch.setattr(steering_study, "compare_estimators", lambda: {"plant": "errors"})
    monkeypatch.setattr(steering_study, "spun_curvatures", lambda: ["spun"])
    made = SteeringStudy.of_parts(*([part() for part in parts] for parts in steering_parts().values()))
    assert made.steered == {order: [order] for order in TurnOrder}
    assert made.known_pose == {speed: ["pose", speed] for speed in planar_study.SPEEDS_MM_S}
    assert made.imaged == {speed: {"case": speed} for speed in planar_study.SPEEDS_MM_S}
    assert (made.fused, made.spun) == ({"plant": "errors"}, ["spun"])
