"""`needle control` runs its stages in order and hands every result to the report."""

from studies.control import study


def test_every_stage_is_announced_and_its_result_kept(monkeypatch):
    """The stages themselves take a minute; each has tests of its own."""
    monkeypatch.setattr(study, "tables_iv_v", lambda: ["iv", "v"])
    monkeypatch.setattr(study, "robustness", lambda: ["robust"])

    def steer(progress):
        for stage in study.STEERING_STAGES:
            progress(stage)
        return "steered"

    monkeypatch.setattr(study, "run_steering", steer)
    announced = []
    made = study.run_study(announced.append)
    assert tuple(announced) == study.STAGES
    assert (made.tables, made.robustness, made.steering) == (["iv", "v"], ["robust"], "steered")
