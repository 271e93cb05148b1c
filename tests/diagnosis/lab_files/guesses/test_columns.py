"""Trials and columns that are drafted from names and numbers."""

from pathlib import Path

import numpy as np
import pytest

from diagnosis.lab_files.guesses.columns import guessed_sources, guessed_trials
from diagnosis.lab_files.guesses.times import guessed_time_columns
from diagnosis.lab_files.readers.lab_table import LabFile, LabTable

TIME = np.arange(0, 10, 0.01)


def file(name, **columns):
    content = {key.replace("__", " "): np.asarray(value, float) for key, value in columns.items()}
    table = LabTable(title=name, columns=content)
    return LabFile(path=Path(name), tables=(table,))


def sources(one):
    open_ = []
    times = guessed_time_columns([one], open_)
    return {c.wanted: c for c in guessed_sources(one.tables, times, open_)}, open_


def test_files_of_one_kind_are_trials():
    open_ = []
    trials = guessed_trials([file("a", t=TIME), file("b", t=TIME)], open_)
    assert [t.lab_files for t in trials] == [("a",), ("b",)]
    assert not any(t.guess for t in trials)
    assert open_ == []


def test_as_many_files_of_two_kinds_are_joined_as_a_guess():
    files = [
        file("m1", t=TIME, m=TIME),
        file("m2", t=TIME, m=TIME),
        file("c1", t=TIME),
        file("c2", t=TIME),
    ]
    trials = guessed_trials(files, [])
    assert [t.lab_files for t in trials] == [("m1", "c1"), ("m2", "c2")]
    assert all(t.guess for t in trials)


def test_files_that_do_not_pair_are_asked_for():
    open_ = []
    guessed_trials([file("m1", t=TIME, m=TIME), file("m2", t=TIME, m=TIME), file("c1", t=TIME)], open_)
    assert "which files belong together" in open_[0]


def test_everything_that_cannot_be_mapped_is_named_in_one_run():
    found, open_ = sources(file("a", t=TIME, motor_angle__in=np.sin(TIME), torque__kip=np.cos(TIME)))
    assert set(found) == {"base_angle_deg", "base_torque_n_mm"}
    for name in ("inserted_mm", "free_mm", "speed_mm_s", "tip_angle_deg", "motor_angle", "'torque kip'"):
        assert any(name in item for item in open_), name


def test_a_unit_that_is_not_known_is_asked_for_with_what_to_write():
    _, open_ = sources(file("a", t=TIME, motor_angle__in=np.sin(TIME), torque=np.cos(TIME)))
    (torque,) = (item for item in open_ if item.startswith("base_torque_n_mm"))
    assert "'unit', e.g. N mm; or add 'factor', N mm per unit of the file" in torque
    (angle,) = (item for item in open_ if item.startswith("base_angle_deg"))
    assert angle.endswith("how many deg is it? write it in the line 'factor'")


def test_a_rate_is_integrated_and_a_depth_differentiated_where_nothing_else_is_there():
    found, _ = sources(file("a", t=TIME, motor__rpm=np.sin(TIME), depth__mm=TIME))
    assert found["base_angle_deg"].source.derive == "integrate"
    assert found["base_angle_deg"].source.unit == "rpm"
    assert found["speed_mm_s"].source.derive == "differentiate"


def test_nothing_is_derived_where_it_was_measured():
    columns = {"motor__rpm": np.sin(TIME), "motor__deg": np.cos(TIME), "depth__mm": TIME}
    found, _ = sources(file("a", t=TIME, feed__velocity__mm_s=np.ones(TIME.size), **columns))
    assert found["base_angle_deg"].source.derive is None
    assert found["speed_mm_s"].source.derive is None


@pytest.mark.parametrize(("velocity", "kept"), [(np.cos(TIME), False), (np.cos(5 * TIME), True)])
def test_the_rate_of_the_base_is_no_axial_speed_whatever_its_name(velocity, kept):
    found, open_ = sources(file("a", t=TIME, disp__mm=np.sin(TIME), vel__mm_s=velocity))
    assert ("speed_mm_s" in found) == kept
    assert any("not an axial speed" in item for item in open_) != kept
