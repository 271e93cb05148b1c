"""Protocols: the paper's by name, one's own in YAML, and what is refused."""

from pathlib import Path

import numpy as np
import pytest

from models.errors import InvalidValue, UnknownName
from sim.experiment import perform, step_error_deg
from sim.paper_protocols import PROTOCOLS, protocol_named
from sim.protocol import Protocol, read_protocol
from sim.simulation import simulate

EXAMPLE = Path(__file__).parent.parent / "examples" / "protocol.yaml"


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


@pytest.mark.parametrize("name", PROTOCOLS)
def test_every_named_protocol_runs_and_converges(name):
    made = protocol_named(name)
    assert made.name == name
    recording = perform(made)
    assert recording["unconverged_count"][-1] == 0
    assert recording["time_s"][-1] == pytest.approx(sum(s.duration_s for s in made.segments))


def test_an_unknown_protocol_is_answered_with_the_known_ones():
    with pytest.raises(UnknownName, match="fig4-10cm"):
        protocol_named("fig99")


def test_segments_follow_one_another():
    schedule = protocol(
        segments=[
            {"duration_s": 2, "turn_deg": 90},
            {"duration_s": 1},
            {"duration_s": 1, "turn_deg": -30, "advance_mm": -5},
        ]
    ).schedule()
    assert np.interp([1, 2, 3, 4], schedule.time_s, schedule.drive) == pytest.approx([45, 90, 90, 60])
    assert schedule.free_mm[-1] == 55
    assert schedule.inserted_mm[-1] == 100
    assert schedule.speed_mm_s[-1] == -5


def test_a_needle_that_is_not_through_goes_deeper_by_what_it_advances():
    schedule = protocol(through=False, segments=[{"duration_s": 2, "advance_mm": 20}]).schedule()
    assert (schedule.free_mm[-1], schedule.inserted_mm[-1]) == (30, 120)


def test_dither_is_sampled_finely():
    schedule = protocol(segments=[{"duration_s": 2, "dither_deg": 10, "dither_hz": 5}]).schedule()
    assert schedule.drive.max() == pytest.approx(10, rel=0.01)
    assert np.diff(schedule.time_s).max() < 1 / 5 / 20


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"tissue": "jelly"}, "tissue"),
        ({"needle": "gold"}, "needle"),
        ({"segments": []}, "segments"),
        ({"segments": [{"duration_s": 0}]}, r"segments\.0\.duration_s"),
        ({"segments": [{"duration_s": 1, "turn": 90}]}, r"segments\.0"),
        ({"segments": [{"duration_s": 1, "advance_mm": 60}]}, r"segments\.0\.advance_mm"),
        ({"segments": [{"duration_s": 1, "dither_deg": 3}]}, r"segments\.0"),
        ({"segments": [{"duration_s": 1, "torque_n_mm": 3}]}, r"segments\.0\.torque_n_mm"),
        ({"drive": {"kind": "torque"}}, r"segments\.0\.torque_n_mm"),
        ({"free_mm": 400}, r"needle\.length_mm"),
        ({"inserted_mm": 0}, "inserted_mm"),
        ({"free_mm": float("nan")}, "free_mm"),
        ({"discretisation": {"elements": 1}}, r"discretisation\.elements"),
        ({"speed": 3}, "speed"),
    ],
)
def test_what_is_wrong_is_named(changes, field):
    with pytest.raises(InvalidValue, match=field):
        protocol(**changes)


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


@pytest.mark.parametrize(
    "text", ["", "just words", "- a\n- list", "name: [unclosed", "name: &a [*a]", "name: x"]
)
def test_a_file_that_is_no_protocol_is_refused(tmp_path, text):
    path = tmp_path / "p.yaml"
    path.write_text(text)
    with pytest.raises(InvalidValue):
        read_protocol(path)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(InvalidValue, match=r"nothing\.yaml"):
        read_protocol(tmp_path / "nothing.yaml")


def test_dry_friction_holds_the_tip_until_retraction_lets_it_go():
    """Section II-B3: the lag of (2) stays while nothing slides, and goes when it does."""
    recording = perform(protocol_named("fig3-simtest"))
    lag = recording["base_angle_deg"] - recording["tip_angle_deg"]
    time = recording["time_s"]
    assert lag[(time > 21) & (time < 29.9)] == pytest.approx(49.58, abs=0.05)
    assert abs(lag[-1]) < 0.1


def test_dither_frees_most_of_the_lag():
    recording = perform(protocol_named("stiction-dither"))
    lag = recording["base_angle_deg"] - recording["tip_angle_deg"]
    assert abs(lag[-1]) < 0.05 * lag[recording["time_s"] < 7].max()
