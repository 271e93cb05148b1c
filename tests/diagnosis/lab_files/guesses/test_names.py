"""Names of columns, as labs give them."""

from pathlib import Path

import numpy as np
import pytest

from diagnosis.lab_files.guesses.names import (
    angular_rate,
    guessed_columns,
    is_rate_of,
)
from diagnosis.lab_files.readers.lab_table import LabTable
from diagnosis.log.rig_log import read_rig_log

EXAMPLES = Path(__file__).parents[4] / "examples"
RNG = np.random.default_rng(1)


def table_of(*names, words=None):
    columns = {name: RNG.normal(size=50) for name in names}
    return LabTable(title="run.csv", columns=columns, words=words or {})


def guessed(*names, words=None):
    found = guessed_columns([table_of(*names, words=words)], [])
    return {guess.wanted: guess.column for guess in found}


@pytest.mark.parametrize(
    ("names", "wanted"),
    [
        (
            ("motor angle [rad]", "Drehmoment (mN m)", "tip camera (deg)"),
            ("base_angle_deg", "base_torque_n_mm", "tip_angle_deg"),
        ),
        (("theta_base", "tau", "theta_tip"), ("base_angle_deg", "base_torque_n_mm", "tip_angle_deg")),
        (
            ("enc [counts]", "Mz (Nmm)", "EM tip roll"),
            ("base_angle_deg", "base_torque_n_mm", "tip_angle_deg"),
        ),
        (("m1_cnt", "Tz", "em_roll"), ("base_angle_deg", "base_torque_n_mm", "tip_angle_deg")),
        (
            ("SURF_ANG [rad]", "TORQUE [kN.m]", "BIT_TURNS [rev]"),
            ("base_angle_deg", "base_torque_n_mm", "tip_angle_deg"),
        ),
        (("disp (in)", "friction force (kip)"), ("base_angle_deg", "base_torque_n_mm")),
        (
            ("insertion depth (mm)", "free length (mm)", "feed velocity (mm/s)"),
            ("inserted_mm", "free_mm", "speed_mm_s"),
        ),
        (("data.base_pos", "data.tip_pos"), ("base_angle_deg", "tip_angle_deg")),
    ],
)
def test_columns_are_found_by_the_words_of_their_names(names, wanted):
    assert guessed(*names) == dict(zip(wanted, names, strict=True))


@pytest.mark.parametrize(
    "name", ["temperature (C)", "motor current (A)", "status", "gripper", "tip temperature", "sample"]
)
def test_other_columns_are_taken_for_nothing(name):
    assert guessed(name) == {}


def test_a_reading_comes_before_its_set_point():
    assert guessed("motor pos set", "motor pos act")["base_angle_deg"] == "motor pos act"


def test_a_rate_is_no_angle_and_an_axial_speed_has_a_length():
    assert "base_angle_deg" not in guessed("motor velocity (rpm)")
    assert "speed_mm_s" not in guessed("motor velocity (rpm)")
    assert "inserted_mm" not in guessed("stage depth (deg)")


def test_the_volts_of_a_sensor_are_no_velocity():
    columns = {"base_angle_deg": "motor angle [V]", "base_torque_n_mm": "Force (V)"}
    assert guessed(*columns.values(), "Input 2 [V]") == columns
    assert angular_rate([table_of("Input 1 [V]")], []) is None


def test_volts_alone_are_no_speed_and_coordinates_no_angle():
    assert guessed("V", "V #2") == {}
    assert guessed("V (mm/s)") == {"speed_mm_s": "V (mm/s)"}
    place = [f"Tip position {axis}" for axis in "xyz"]
    assert "tip_angle_deg" not in guessed(*place, *(f"Tip orientation {axis}" for axis in "xyzw"))
    assert guessed("Base orientation z", "Base orientation w") == {}


def test_an_angle_about_an_axis_stays_an_angle():
    assert guessed("tip rotation x", "tip rotation z")["tip_angle_deg"].startswith("tip rotation")
    assert guessed("tip position z")["tip_angle_deg"] == "tip position z"  # no other coordinate


def test_a_joint_is_known_by_the_name_that_its_message_gives():
    words = {"/js.position[0]": "slide", "/js.position[1]": "needle_tip"}
    assert (
        guessed("/js.position[0]", "/js.position[1]", words=words)["tip_angle_deg"] == "/js.position[1]"
    )


def test_columns_that_would_do_as_well_are_told():
    (guess,) = guessed_columns([table_of("torque a", "torque b")], [])
    assert len(guess.alike) == 1


def test_the_columns_of_rig_log_are_those_of_the_same_names():
    trial = read_rig_log(EXAMPLES / "rig-log").trials[0].table
    table = LabTable(title="x", columns={name: trial[name].to_numpy() for name in trial})
    found = guessed_columns([table], ["time_s"])
    assert {g.wanted: g.column for g in found} == {n: n for n in trial if n != "time_s"}


def test_a_rate_of_the_base_is_found_where_there_is_no_angle():
    table = table_of("motor (rpm)", "torque")
    assert angular_rate([table], []) == (table, "motor (rpm)")
    assert angular_rate([table], ["motor (rpm)"]) is None
    assert angular_rate([table_of("feed (mm/s)", "tip rate (deg/s)")], []) is None


def test_the_rate_of_a_column_is_told_from_another_speed():
    time = np.arange(0, 10, 0.01)
    angle = np.sin(time)
    assert is_rate_of(-3 * np.cos(time), time, angle)
    assert not is_rate_of(np.cos(3 * time), time, angle)
    assert not is_rate_of(np.zeros(time.size), time, angle)
