"""Protocols in closed loop: the base angle of the protocol becomes the reference of the tip."""

import numpy as np
import pytest

from models.errors import InvalidValue, UnknownName
from sim.paper_protocols import protocol_named
from studies.control.closed_loop_run import perform_closed_loop
from studies.control.tip_controllers import TIP_CONTROLLERS


@pytest.mark.parametrize("name", TIP_CONTROLLERS)
def test_every_tip_controller_brings_the_tip_to_the_reference_during_an_insertion(name):
    short = protocol_named("insertion").but(
        segments=[
            {"duration_s": 0.6, "advance_mm": 20},
            {"duration_s": 0.5, "turn_deg": 90, "advance_mm": 5},
            {"duration_s": 0.5, "advance_mm": 5},
        ],
        tissue="viscous-plastisol",
    )
    recording = perform_closed_loop(short, name)
    assert np.isfinite(recording.table.to_numpy()).all()
    assert abs(recording["tip_angle_deg"][-1] - 90) < 3
    assert "path_z_mm" in recording.table


SHORT = protocol_named("fig5-5cm").but(segments=[{"duration_s": 0.05, "turn_deg": 5}])


def test_the_recording_names_the_controller_and_takes_steps_of_two_milliseconds():
    recording = perform_closed_loop(SHORT, "feedforward")
    assert recording.parameters["controller"] == "feedforward"
    assert "feedforward" in recording.parameters["description"]
    assert np.diff(recording["time_s"]) == pytest.approx(0.002)
    assert recording["wanted_tip_deg"][-1] == pytest.approx(5.0)


def test_a_needle_that_is_driven_by_torque_cannot_be_run_in_closed_loop():
    driven = SHORT.but(drive={"kind": "torque"}, segments=[{"duration_s": 1, "torque_n_mm": 0.1}])
    with pytest.raises(InvalidValue, match=r"drive\.kind: expected 'angle'.*found 'torque'"):
        perform_closed_loop(driven, "feedforward")


def test_an_unknown_controller_is_answered_with_the_known_ones():
    with pytest.raises(UnknownName, match="least_time"):
        perform_closed_loop(SHORT, "magic")
