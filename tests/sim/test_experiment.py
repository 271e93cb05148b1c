"""Running a protocol: the recording, and the check of the step where accuracy is asked for."""

from pathlib import Path

import pytest

from models.errors import InvalidValue
from sim.experiment import perform, step_error_deg
from sim.protocol import Protocol, read_protocol
from sim.simulation import simulate

EXAMPLE = Path(__file__).parents[2] / "examples" / "protocol.yaml"


def protocol(**changes):
    good = {
        "name": "test",
        "tissue": "viscous-plastisol",
        "free_mm": 50,
        "inserted_mm": 100,
        "through": True,
        "segments": [{"duration_s": 1, "turn_deg": 90}],
    }
    return Protocol(**(good | changes))


def test_a_step_too_large_for_the_accuracy_is_an_error_that_says_which_would_do():
    hasty = protocol(
        segments=[{"duration_s": 0.3, "turn_deg": 90}, {"duration_s": 2}],
        accuracy_deg=1e-3,
        discretisation={"step_s": 0.05},
    )
    with pytest.raises(InvalidValue, match=r"step_s.*try") as raised:
        perform(hasty)
    suggested = float(raised.value.fix.split()[1])
    enough = hasty.but(discretisation={"step_s": suggested}, accuracy_deg=None)
    run = simulate([enough.setup()], enough.schedule())[0]
    assert step_error_deg(enough, run) < 1.5e-3


def test_the_example_protocol_is_read_and_runs():
    recording = perform(read_protocol(EXAMPLE))
    assert recording.parameters["tip_error_deg"] < 0.2


def test_without_an_accuracy_no_error_is_estimated():
    recording = perform(protocol())
    assert "tip_error_deg" not in recording.parameters
    assert recording.parameters["protocol"] == "test"
    assert recording.group("shaft").shape[1] == len(recording.parameters["nodes_mm"])


def test_the_estimated_error_falls_with_the_square_of_the_step():
    coarse, fine = (
        protocol(
            segments=[{"duration_s": 0.4, "turn_deg": 90}, {"duration_s": 0.8}],
            discretisation={"step_s": step},
        )
        for step in (0.04, 0.02)
    )
    errors = [step_error_deg(p, simulate([p.setup()], p.schedule())[0]) for p in (coarse, fine)]
    # Second order in 1.7 to 2.3: the corner of the turn falls on the end of a step.
    assert 2**1.7 < errors[0] / errors[1] < 2**2.3
