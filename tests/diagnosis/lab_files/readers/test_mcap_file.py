"""MCAP files as numbers."""

import numpy as np
import pytest
from lab_files import KNOWN, LAB, write_json_mcap, write_ros2

from diagnosis.lab_files.readers.mcap_file import read_mcap_file
from models.errors import InvalidValue

FEW = KNOWN.iloc[:40]


def test_ros2_messages_come_back_with_the_time_of_their_header(tmp_path):
    file = read_mcap_file(write_ros2(tmp_path, FEW))
    columns = {name: values for table in file.tables for name, values in table.columns.items()}
    np.testing.assert_array_equal(
        columns["/joint_states.position[0]"], np.radians(FEW["base_angle_deg"])
    )
    np.testing.assert_array_equal(columns["/wrench.wrench.torque.z"], FEW["base_torque_n_mm"] / 1000)
    stamp = columns["/wrench.header.stamp"]
    # Seconds since 1970 are good to 2.4e-7 s in double precision.
    np.testing.assert_allclose(stamp - stamp[0], FEW["time_s"], atol=5e-7)
    np.testing.assert_allclose(columns["/wrench.log_time"] - stamp, 0.003, atol=5e-7)


def test_a_joint_lends_its_name_to_its_numbers(tmp_path):
    table = next(t for t in read_mcap_file(write_ros2(tmp_path, FEW)).tables if "joint" in t.title)
    assert table.words == {
        "/joint_states.position[0]": "base_joint",
        "/joint_states.position[1]": "idle",
    }
    assert table.ros_units


def test_a_topic_whose_joints_change_places_is_left_out_with_a_note(tmp_path):
    path = write_ros2(tmp_path, FEW, names=lambda i: ("a", "b") if i % 2 else ("b", "a"))
    file = read_mcap_file(path)
    assert not any("joint" in table.title for table in file.tables)
    assert any("/joint_states lists its joints in changing order" in note for note in file.notes)


def test_json_comes_back_and_an_unknown_encoding_is_noted(tmp_path):
    file = read_mcap_file(write_json_mcap(tmp_path, LAB.iloc[:40]))
    (table,) = file.tables
    np.testing.assert_array_equal(table.columns["/rig.torque (N m)"], LAB["torque (N m)"][:40])
    assert not table.ros_units
    assert any("/other" in note and "cbor" in note for note in file.notes)


@pytest.mark.parametrize("kept", [0.0, 0.5])
def test_what_is_no_whole_mcap_is_refused_by_its_name(tmp_path, kept):
    path = write_ros2(tmp_path, FEW)
    data = path.read_bytes()
    path.write_bytes(data[: int(kept * len(data))])
    with pytest.raises(InvalidValue, match=r"run\.mcap"):
        read_mcap_file(path)


def test_a_message_definition_that_is_broken_is_refused_by_its_name(tmp_path):
    path = write_ros2(tmp_path)
    path.write_bytes(path.read_bytes().replace(b"MSG: geometry_msgs", b"MSG:  eometry_msgs"))
    with pytest.raises(InvalidValue, match="complete MCAP file"):
        read_mcap_file(path)
