"""`needle control` runs its stages in order and hands every result to the report."""

from studies.control import study
from studies.control.steering import approach_plane


def test_every_stage_is_announced_and_its_result_kept(monkeypatch):
    """The stages themselves take a minute; each has tests of its own."""
    monkeypatch.setattr(study, "tables_iv_v", lambda: ["iv", "v"])
    monkeypatch.setattr(study, "robustness", lambda: ["robust"])
    monkeypatch.setattr(study, "steered_insertions", lambda: ["steered"])
    monkeypatch.setattr(
        study,
        "approach_plane",
        lambda speed_mm_s: approach_plane(
            speed_mm_s=speed_mm_s, travel_mm=1.0, cases=("its own simulation",)
        ),
    )
    announced = []
    made = study.run_study(announced.append)
    assert tuple(announced) == study.STAGES
    assert (made.tables, made.robustness, made.steered) == (["iv", "v"], ["robust"], ["steered"])
    assert tuple(made.planes) == study.PLANAR_SPEEDS_MM_S
    # slower needles take more samples to travel the same millimetre
    samples = [approaches[0].height_mm.size for approaches in made.planes.values()]
    assert samples == sorted(samples, reverse=True)
