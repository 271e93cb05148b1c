"""Names, units and settings above the numbers, as recorders write them."""

import pytest

from diagnosis.lab_files.readers.text_header import header_names, settings


@pytest.mark.parametrize(
    ("names", "units", "expected"),
    [
        ("Time,Force", "ms,V", ["Time [ms]", "Force [V]"]),
        ("Time,Force,Bath", "s,(N),°C", ["Time [s]", "Force [N]", "Bath [°C]"]),
        ("Time,Analog 1,Analog 2", "ms,Motor speed,Torque", ["Time [ms]", "Motor speed", "Torque"]),
        ("Channel,Force,Channel,In", "Unit,V,Unit,V", ["", "Force [V]", "", "In [V]"]),
        ("t,x", "-,mm", ["t", "x [mm]"]),
        ("TIME,RUN,ANG,RATE", "[s],[-],[rad],[m/h]", ["TIME [s]", "RUN", "ANG [rad]", "RATE [m/h]"]),
        ("depth,rate", "[furlong],[m/h]", ["depth [furlong]", "rate [m/h]"]),
    ],
)
def test_names_are_kept_above_their_units(names, units, expected):
    assert header_names(["Axis 1", names, units], ",", len(expected)) == expected


@pytest.mark.parametrize("above", ["# rig;2", "rig 2", "", "1;2"])
def test_a_line_that_is_no_header_gives_no_name(above):
    assert header_names([above, "t;m"], ";", 2) == ["t", "m"]


def test_a_line_of_units_alone_is_all_there_is():
    assert header_names(["s;deg"], ";", 2) == ["s", "deg"]


@pytest.mark.parametrize(
    ("line", "separator", "decimal", "name", "value"),
    [
        ("Interval,0.0005,Interval,0.0005", ",", ".", "Interval", 0.0005),
        ("Interval;0,0005", ";", ",", "Interval", 0.0005),
        ("# rate = 100 Hz", ";", ".", "rate", 100),
        ("% Sampling time interval(ms): 0.667", ",", ".", "Sampling time interval(ms)", 0.667),
    ],
)
def test_a_number_beside_a_name_is_a_setting(line, separator, decimal, name, value):
    assert settings([line], separator, decimal) == {name: value}


@pytest.mark.parametrize("line", ["bench 2, gelatine", "t,x", "", "3,4", "start: 10:12", "a\x1b,5"])
def test_other_lines_are_no_settings(line):
    assert settings([line], ",", ".") == {}
