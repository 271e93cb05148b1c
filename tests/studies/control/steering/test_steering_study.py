"""The stages of steering are announced in order and kept under their speeds."""

from studies.control.steering import planar_study, steering_study
from studies.control.steering.steered_insertions import TurnOrder


def test_every_stage_is_announced_and_its_result_kept(monkeypatch):
    """The stages themselves have tests of their own."""
    monkeypatch.setattr(steering_study, "steered_insertions", lambda order: [order])
    monkeypatch.setattr(steering_study, "approach_plane", lambda speed_mm_s: ["pose", speed_mm_s])
    monkeypatch.setattr(steering_study, "imaged_approaches", lambda speed_mm_s: {"case": speed_mm_s})
    monkeypatch.setattr(steering_study, "compare_estimators", lambda: {"plant": "errors"})
    monkeypatch.setattr(steering_study, "spun_curvatures", lambda: ["spun"])
    announced = []
    made = steering_study.run_steering(announced.append)
    assert tuple(announced) == steering_study.STEERING_STAGES
    assert made.steered == {order: [order] for order in TurnOrder}
    assert made.known_pose == {speed: ["pose", speed] for speed in planar_study.SPEEDS_MM_S}
    assert made.imaged == {speed: {"case": speed} for speed in planar_study.SPEEDS_MM_S}
    assert (made.fused, made.spun) == ({"plant": "errors"}, ["spun"])
