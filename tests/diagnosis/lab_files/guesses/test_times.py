"""Columns of times, by name or by equal steps, and what the user is asked where there is none."""

from pathlib import Path

import numpy as np
import pytest

from diagnosis.lab_files.guesses.times import guessed_time_columns, times_of
from diagnosis.lab_files.readers.lab_table import LabFile, LabTable

RISING = np.arange(0, 10, 0.01)
WAVE = np.sin(RISING)


def table_of(**columns):
    return LabTable(title="run.csv", columns={name: np.asarray(v, float) for name, v in columns.items()})


def drafted_times(scalars=None, **columns):
    open_ = []
    file = LabFile(path=Path("run.csv"), tables=(table_of(**columns),), scalars=scalars or {})
    return guessed_time_columns([file], open_), open_


def test_times_rise_and_are_called_so():
    rising = np.arange(5.0)
    columns = {"t": rising[::-1], "time": rising, "travel": rising, "x.stamp": rising}
    assert times_of(table_of(**columns)) == "x.stamp"
    del columns["x.stamp"]
    assert times_of(table_of(**columns)) == "time"
    del columns["time"]
    assert times_of(table_of(**columns)) is None


def test_a_few_times_that_go_back_are_an_error_of_the_rows_and_not_another_column():
    time_s = np.arange(200.0)
    time_s[[50, 51]] = time_s[[51, 50]]
    assert times_of(table_of(time=time_s)) == "time"
    time_s[::20] -= 5.0
    assert times_of(table_of(time=time_s)) is None


def test_a_column_of_equal_steps_is_offered_as_a_guess_that_has_to_be_confirmed():
    (guess,), open_ = drafted_times(x=WAVE, column_1=np.round(RISING / 15, 6))
    assert guess.source.column == "column_1"
    assert guess.source.guess
    assert "equal steps of 0.0006" in guess.because
    assert "'column_1'" in open_[0]


@pytest.mark.parametrize("name", ["motor angle [deg]", "insertion depth", "x (V)", "deg"])
def test_what_is_called_something_else_is_no_time_however_it_rises(name):
    assert times_of(table_of(**{name: RISING, "x": WAVE})) is None


def test_uneven_steps_and_counters_are_no_times():
    assert times_of(table_of(x=WAVE, y=RISING**2)) is None
    times, open_ = drafted_times(x=WAVE[:50], n=np.arange(1, 51))
    assert times == []
    assert "'n' counts the rows" in open_[0]


@pytest.mark.parametrize(
    ("scalars", "columns", "told"),
    [
        ({"fs": 256.0, "mass": 3.0}, {}, "sample_hz: 256, if 'fs' is it"),
        ({"Interval": 0.0005}, {}, "sample_hz: 2000, if 'Interval' = 0.0005 is in s"),
        ({"Sampling time interval(ms)": 0.5}, {}, "sample_hz: 2000, if 'Sampling time interval(ms)'"),
        ({}, {"dt_ms": np.full(RISING.size, 4.0)}, "sample_hz: 250, if 'dt_ms' = 4 is in ms"),
        ({"mass": 3.0}, {}, "in the file: mass = 3"),
    ],
)
def test_without_times_the_numbers_that_may_be_a_rate_are_told(scalars, columns, told):
    _, open_ = drafted_times(scalars, motor_angle=WAVE, **columns)
    assert told in open_[0]
    assert "'sample_hz'" in open_[0]
