"""Why a sensor is late."""

from dataclasses import replace

import pytest
from diagnosis_fixtures import scored

from diagnosis.selection.stages import late_sensors as module
from diagnosis.workers import Workers

TORQUE_LAGS = (
    *("torque_average", "torque_butterworth", "torque_clock", "torque_low_pass"),
    "torque_sensor_delay",
)


def test_a_delay_may_be_an_imperfection_of_its_sensor(asked, still_start):
    """Of the same sensor, and no set twice."""
    late = scored(["tip_drag", "torque_sensor_delay"], 1.0)
    known = scored(["torque_clock", "tip_drag"], 2.0)
    module.imperfections_in_place(replace(still_start, candidates=(late, known)), Workers())
    assert asked == [
        ("tip_drag", name) for name in ("torque_average", "torque_butterworth", "torque_low_pass")
    ]
    asked.clear()
    tip = scored(["tip_sensor_delay"], 1.0)
    module.imperfections_in_place(replace(still_start, candidates=(tip,)), Workers())
    assert asked == [("tip_clock",)]
    asked.clear()
    other = scored(["tissue_viscoelasticity"], 1.0)  # its time constant is no delay of a sensor
    module.imperfections_in_place(replace(still_start, candidates=(other,)), Workers())
    assert asked == []


@pytest.mark.parametrize("lag", ["torque_sensor_delay", "torque_butterworth"])
def test_a_lag_beside_one_low_pass_may_be_another_one(lag, asked, still_start):
    both = scored(["torque_low_pass", lag], 1.0)
    module.imperfections_in_place(replace(still_start, candidates=(both,)), Workers())
    assert {("torque_average",), ("torque_low_pass",), ("torque_sensor_delay",)} <= {*asked} | {(lag,)}
    assert all({*names} <= {*TORQUE_LAGS} for names in asked)


@pytest.mark.parametrize(("behind", "fitted"), [(1.0, True), (100.0, False)])
def test_what_is_as_likely_as_the_best_gets_the_delay_of_the_library_too(
    behind, fitted, asked, still_start
):
    """Else the drag would be told beside a filter only, and the insertion beside both."""
    found = (
        scored(["inserted_offset", "torque_low_pass"], 1.0),
        scored(["tip_drag", "torque_low_pass"], 1.0 + behind),
    )
    module.imperfections_in_place(replace(still_start, candidates=found), Workers())
    beside_drag = [names for names in asked if "tip_drag" in names]
    assert beside_drag == ([("tip_drag", "torque_sensor_delay")] if fitted else [])
