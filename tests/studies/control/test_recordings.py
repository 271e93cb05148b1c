"""Which steps are recorded, and what a recording of one holds."""

import math
from dataclasses import replace

import numpy as np
import pytest

from studies.control import recordings
from studies.control.comparison import StepResponse
from studies.control.recordings import stems, step_recordings
from studies.control.robustness import plants
from studies.control.tables import CONTROLLERS


def response(controller, plant="viscous-plastisol", **changes):
    return StepResponse(
        **(
            {
                "tissue": "viscous-plastisol",
                "depth_cm": 10.0,
                "free_mm": 50.0,
                "controller": controller,
                "settle_s": 1.0,
                "integral_deg_s": 20.0,
                "overshoot_deg": 0.0,
                "largest_base_deg": 100.0,
                "plant": plant,
                "shear_stress_mpa": 100.0,
                "final_error_deg": 0.0,
            }
            | changes
        )
    )


def test_every_file_that_is_announced_is_made_and_no_other():
    tables = [response(name, depth_cm=d) for d in (5.0, 10.0) for name in CONTROLLERS]
    robust = [response(name, plant) for plant in plants() for name in ("base_only", "lqr", "feedback")]
    assert [one.stem for one in step_recordings(tables, robust)] == stems()
    assert len(set(stems())) == len(stems())


@pytest.mark.parametrize(
    ("worse", "better"),
    [
        ({"settle_s": math.nan, "final_error_deg": 4.0}, {"settle_s": 3.0}),
        ({"overshoot_deg": 12.0, "settle_s": 0.5}, {"settle_s": 3.0}),
        ({"settle_s": 2.0}, {"settle_s": 1.9}),
    ],
)
def test_best_and_worst_are_ranked_by_failures_then_settling(worse, better):
    rig = "as designed"
    rows = [response("lqr", rig, **worse), response("adaptive", rig, **better)]
    rows.append(response("base_only", rig, settle_s=math.nan))
    made = {one.stem: one for one in step_recordings([], rows)}
    assert made["robust_as-designed_best"].make.__closure__ is not None
    ranked = sorted(rows[:2], key=recordings._badness)
    assert [r.controller for r in ranked] == ["adaptive", "lqr"]


def test_a_recording_holds_what_is_what_is_measured_what_is_estimated_and_what_is_commanded(monkeypatch):
    monkeypatch.setattr(recordings, "_ROBUST_SHOWN_S", 0.3)
    rig = "all of it"
    row = replace(response("unbiased", rig), settle_s=math.nan, final_error_deg=5.0)
    one = step_recordings([], [row])[0]
    assert any("never settles" in line for line in one.results)
    made = one.make()
    names = {"wanted_tip_deg", "estimate_tip_deg", "estimate_bias_n_mm", "command_base_deg"}
    names |= {"measured_base_deg", "measured_torque_n_mm", "measured_tip_deg", "base_angle_deg"}
    assert names <= set(made.table.columns)
    counts = made["measured_base_deg"] / 0.36
    assert counts == pytest.approx(np.round(counts))
    assert made.group("shaft").shape[0] == made["time_s"].size
    assert made.parameters["hardware"]["sensors"]["torque_bias_n_mm"] == 0.1
