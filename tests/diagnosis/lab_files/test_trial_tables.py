"""A mapping applied to files whose content is known."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from lab_files import (
    KNOWN,
    LAB,
    MAT_NAMES,
    mapping_of,
    write_csv,
    write_json_mcap,
    write_mat,
    write_parquet,
    write_ros2,
)

from diagnosis.lab_files.mapping import ImportMapping
from diagnosis.lab_files.readers.lab_table import LabFile, LabTable
from diagnosis.lab_files.readers.read import read_lab_files
from diagnosis.lab_files.trial_tables import imported_trial
from models.errors import InvalidValue


def applied(paths, mapping):
    mapping = ImportMapping(**mapping)
    return imported_trial(mapping, mapping.trials[0], read_lab_files(paths))


def renamed(mapping, name):
    """The mapping with other names of columns."""
    columns = {k: {**v, "column": name(v["column"])} for k, v in mapping["columns"].items()}
    times = [{**t, "column": name(t["column"])} for t in mapping["times"]]
    return {**mapping, "columns": columns, "times": times}


def assert_known(table, atol=1e-9):
    for name in KNOWN:
        np.testing.assert_allclose(table[name], KNOWN[name], atol=atol, err_msg=name)


@pytest.mark.parametrize(("separator", "decimal"), [(";", ","), (",", "."), ("\t", ".")])
def test_a_csv_gives_the_trial_that_it_was_made_of(tmp_path, separator, decimal):
    path = write_csv(tmp_path, separator=separator, decimal=decimal)
    assert_known(applied([path], mapping_of(["run.csv"])).table)


def test_parquet_gives_the_trial_that_it_was_made_of(tmp_path):
    assert_known(applied([write_parquet(tmp_path)], mapping_of(["run.parquet"])).table)


def test_mat_gives_the_trial_that_it_was_made_of(tmp_path):
    mapping = renamed(mapping_of(["run.mat"]), lambda name: f"run.{MAT_NAMES[name]}")
    assert_known(applied([write_mat(tmp_path)], mapping).table)


def test_json_in_mcap_gives_the_trial_that_it_was_made_of(tmp_path):
    mapping = renamed(mapping_of(["run.mcap"]), lambda name: f"/rig.{name}")
    assert_known(applied([write_json_mcap(tmp_path)], mapping).table)


ROS = {
    "times": [
        {"column": f"/{topic}.header.stamp", "unit": "s"}
        for topic in ("joint_states", "wrench", "tip_angle")
    ],
    "columns": {
        "base_angle_deg": {"column": "/joint_states.position[0]", "unit": "rad"},
        "base_torque_n_mm": {"column": "/wrench.wrench.torque.z", "unit": "N m"},
        "tip_angle_deg": {"column": "/tip_angle.vector.z", "unit": "rad"},
    },
    "constants": {"inserted_mm": 100, "free_mm": 70, "speed_mm_s": 0},
}


def test_ros_topics_give_the_trial_that_they_were_made_of(tmp_path):
    """Stamps are good to 2.4e-7 s; the base turns by 120 deg/s and noise by up to 10 deg/s."""
    path = write_ros2(tmp_path)
    trial = applied([path], mapping_of(["run.mcap"], resample_hz=100, **ROS))
    rows = len(trial.table)
    assert rows in (len(KNOWN) - 1, len(KNOWN))
    for name in KNOWN:
        np.testing.assert_allclose(trial.table[name], KNOWN[name][:rows], atol=1e-4, err_msg=name)
    assert any("100 to 100 Hz" in note for note in trial.notes)


def test_a_late_clock_is_put_right_by_its_offset(tmp_path):
    path = write_ros2(tmp_path, torque_late_s=0.35)
    columns = ROS["columns"]
    torque = {**columns["base_torque_n_mm"], "time_offset_s": -0.35}
    mapping = mapping_of(["run.mcap"], resample_hz=100, **ROS)
    right = applied([path], {**mapping, "columns": {**columns, "base_torque_n_mm": torque}}).table
    wrong = applied([path], mapping).table
    known = KNOWN["base_torque_n_mm"]
    np.testing.assert_allclose(right["base_torque_n_mm"], known[: len(right)], atol=1e-4)
    assert np.nanmax(np.abs(wrong["base_torque_n_mm"] - known[: len(wrong)])) > 1


def test_clocks_of_their_own_need_a_stated_rate(tmp_path):
    with pytest.raises(InvalidValue, match=r"resample_hz.*base_angle_deg of run\.mcap, /joint_states"):
        applied([write_ros2(tmp_path)], mapping_of(["run.mcap"], **ROS))


def files_of(**columns):
    """One file in memory."""
    return [LabFile(path=Path("run.csv"), tables=(LabTable(title="run.csv", columns=columns),))]


def in_memory(content, **changes):
    mapping = ImportMapping(**mapping_of(["run.csv"], **changes))
    return imported_trial(mapping, mapping.trials[0], files_of(**content)).table


def test_an_angle_is_integrated_from_a_rate_and_a_speed_differentiated_from_a_depth():
    time = np.arange(0, 5, 0.01)
    columns = {"t": time, "rpm": 2 * np.sin(time), "z": 50 + 3 * time, "m": np.ones(time.size)}
    table = in_memory(
        columns,
        times=[{"column": "t", "unit": "s"}],
        columns={
            "base_angle_deg": {"column": "rpm", "unit": "rpm", "derive": "integrate", "start": 7},
            "inserted_mm": {"column": "z", "unit": "mm"},
            "speed_mm_s": {"column": "z", "unit": "mm", "derive": "differentiate"},
            "free_mm": {"column": "z", "unit": "mm", "sign": -1, "zero": 200},
            "base_torque_n_mm": {"column": "m", "unit": "mN m"},
        },
        constants={},
    )
    # 1 rpm is 6 deg/s; the trapezoidal rule is off by step^2 / 12 of the rate's change.
    np.testing.assert_allclose(table["base_angle_deg"], 7 + 12 * (1 - np.cos(time)), atol=1e-3)
    np.testing.assert_allclose(table["speed_mm_s"], 3, rtol=1e-9)
    np.testing.assert_allclose(table["free_mm"], 150 - 3 * time)


def test_an_angle_that_wraps_counts_on_where_the_mapping_says_so():
    time = np.arange(0, 8, 0.01)
    turned = 90.0 * time  # deg: two turns
    wrapped = (turned + 180.0) % 360.0 - 180.0
    wrapped[300] = np.nan
    tip = {"column": "roll", "unit": "deg"}
    columns = {name: LAB[name].to_numpy()[: time.size] for name in LAB} | {"roll": wrapped}
    of = mapping_of([""])["columns"]
    counted = in_memory(columns, columns={**of, "tip_angle_deg": {**tip, "unwrap": True}})
    read = np.arange(time.size) != 300
    np.testing.assert_allclose(counted["tip_angle_deg"][read], turned[read], atol=1e-9)
    assert np.isnan(counted["tip_angle_deg"][300])
    plain = in_memory(columns, columns={**of, "tip_angle_deg": tip})
    np.testing.assert_allclose(plain["tip_angle_deg"], wrapped)


def test_a_zero_from_the_first_rest_is_each_trials_own():
    columns = {name: LAB[name].to_numpy() for name in LAB}
    torque = {"column": "torque (N m)", "unit": "N m", "sign": -1, "zero": "first_rest"}
    table = in_memory(columns, columns={**mapping_of([""])["columns"], "base_torque_n_mm": torque})
    first = slice(0, 80)
    assert table["base_torque_n_mm"][first].mean() == pytest.approx(0, abs=4 * 0.015 / np.sqrt(80))
    moved = {name: values[200:] for name, values in columns.items()}
    moved["motor angle [rad]"] = moved["motor angle [rad]"] + LAB["t (ms)"].to_numpy()[200:] / 1e3
    with pytest.raises(InvalidValue, match="first_rest"):
        in_memory(moved, columns={**mapping_of([""])["columns"], "base_torque_n_mm": torque})


@pytest.mark.parametrize(
    ("change", "named"),
    [
        (lambda c: c | {"t (ms)": c["t (ms)"][::-1]}, r"run\.csv: times, row 2"),
        (lambda c: c | {"free": np.where(c["free"] > 0, np.nan, 0)}, r"column 'free', row 1"),
        (
            lambda c: {k: v for k, v in c.items() if k != "free"},
            r"columns\.free_mm\.column.*'motor angle",
        ),
        (lambda c: {k: v for k, v in c.items() if k != "t (ms)"}, r"run\.csv: times"),
    ],
)
def test_bad_input_names_file_and_column(change, named):
    columns = change({name: LAB[name].to_numpy() for name in LAB})
    with pytest.raises(InvalidValue, match=named):
        in_memory(columns)


def test_files_without_times_have_a_stated_rate():
    columns = {name: LAB[name].to_numpy() for name in LAB if name != "t (ms)"}
    table = in_memory(columns, times=[], sample_hz=100.0)
    np.testing.assert_allclose(table["time_s"], KNOWN["time_s"], atol=1e-9)
    assert isinstance(table, pd.DataFrame)


def test_a_zero_from_a_rest_needs_a_base():
    torque = {"column": "torque (N m)", "unit": "N m", "zero": "first_rest"}
    columns = {name: LAB[name].to_numpy() for name in LAB}
    with pytest.raises(InvalidValue, match="base_angle_deg"):
        in_memory(
            columns,
            columns={"base_torque_n_mm": torque},
            constants={"base_angle_deg": 0, "inserted_mm": 1, "free_mm": 1, "speed_mm_s": 0},
            resample_hz=50,
        )
