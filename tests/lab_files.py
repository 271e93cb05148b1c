"""A known trial as a lab would have it: other names, units, signs and zeros, in every format."""

import json

import numpy as np
import pandas as pd
from analytic_log import TURNS
from mcap.writer import Writer as PlainWriter
from mcap_ros2.writer import Writer
from scipy.io import savemat

KNOWN = TURNS
TORQUE_ZERO_N_M = 0.002
LAB = pd.DataFrame(
    {
        "t (ms)": 1000 * KNOWN["time_s"],
        "motor angle [rad]": np.radians(KNOWN["base_angle_deg"]),
        "torque (N m)": TORQUE_ZERO_N_M - KNOWN["base_torque_n_mm"] / 1000,
        "tip camera (deg)": KNOWN["tip_angle_deg"],
        "stage depth (cm)": KNOWN["inserted_mm"] / 10,
        "free": KNOWN["free_mm"],
    }
)
RIG = {
    "needle": {"diameter_mm": 0.59, "shear_modulus_gpa": 27.2, "density_g_cm3": 6.45},
    "tissue": {"damping_n_mm_s_per_mm": 0.017},
    "sensors": {
        "tip_angle_noise_deg": 0.4,
        "base_torque_noise_n_mm": 0.015,
        "base_angle_noise_deg": 0.02,
    },
}


def mapping_of(files, **changes):
    """The right mapping of `LAB`, one trial for each file."""
    return {
        "format": "rig-import/1",
        "trials": [{"file": f"trial_{i:02d}.csv", "lab_files": [f]} for i, f in enumerate(files)],
        "times": [{"column": "t (ms)", "unit": "ms"}],
        "columns": {
            "base_angle_deg": {"column": "motor angle [rad]", "unit": "rad"},
            "base_torque_n_mm": {
                "column": "torque (N m)",
                "unit": "N m",
                "sign": -1,
                "zero": TORQUE_ZERO_N_M,
            },
            "tip_angle_deg": {"column": "tip camera (deg)", "unit": "deg"},
            "inserted_mm": {"column": "stage depth (cm)", "unit": "cm"},
            "free_mm": {"column": "free", "unit": "mm"},
        },
        "constants": {"speed_mm_s": 0},
        **RIG,
        **changes,
    }


def write_csv(folder, table=LAB, *, separator=";", decimal=",", head="# bench 3\n", digits=12):
    """A CSV with a comment above its header."""
    text = table.to_csv(index=False, sep=separator, decimal=decimal, float_format=f"%.{digits}g")
    path = folder / "run.csv"
    path.write_text(head + text, encoding="utf-8-sig")
    return path


def write_parquet(folder, table=LAB):
    path = folder / "run.parquet"
    table.to_parquet(path)
    return path


MAT_NAMES = {
    "t (ms)": "t_ms",
    "motor angle [rad]": "motor_angle_rad",
    "torque (N m)": "torque_n_m",
    "tip camera (deg)": "tip_deg",
    "stage depth (cm)": "depth_cm",
    "free": "free_mm",
}


def write_mat(folder, table=LAB):
    """A struct of column vectors, and a single number beside it."""
    path = folder / "run.mat"
    columns = {MAT_NAMES[name]: table[name].to_numpy()[:, None] for name in table}
    savemat(path, {"run": columns, "fs": 100.0})
    return path


_HEADER = """\
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""
_VECTOR = """\
================================================================================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
"""
JOINT_STATE = "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] effort\n" + _HEADER
WRENCH = (
    "std_msgs/Header header\ngeometry_msgs/Wrench wrench\n"
    + _HEADER
    + "=" * 80
    + "\nMSG: geometry_msgs/Wrench\ngeometry_msgs/Vector3 force\ngeometry_msgs/Vector3 torque\n"
    + _VECTOR
)
VECTOR = "std_msgs/Header header\ngeometry_msgs/Vector3 vector\n" + _HEADER + _VECTOR


def write_ros2(folder, table=KNOWN, *, torque_late_s=0.0, names=("base_joint", "idle")):
    """Joint states, a wrench and the tip's roll, in CDR; all at the same times but for a late clock."""
    path = folder / "run.mcap"
    with path.open("wb") as file, Writer(file) as writer:
        joint = writer.register_msgdef("sensor_msgs/JointState", JOINT_STATE)
        wrench = writer.register_msgdef("geometry_msgs/WrenchStamped", WRENCH)
        vector = writer.register_msgdef("geometry_msgs/Vector3Stamped", VECTOR)
        for i, row in enumerate(table.itertuples()):
            ns = 1_700_000_000_000_000_000 + round(1e9 * row.time_s)
            late = ns + round(1e9 * torque_late_s)
            order = names if isinstance(names, tuple) else names(i)
            state = {
                "header": _header(ns),
                "name": list(order),
                "position": [np.radians(row.base_angle_deg), 0.0],
                "effort": [],
            }
            writer.write_message("/joint_states", joint, state, log_time=ns + 3_000_000)
            pull = {
                "force": {"x": 0.0, "y": 0.0, "z": 0.1},
                "torque": {"x": 0.0, "y": 0.0, "z": row.base_torque_n_mm / 1000},
            }
            message = {"header": _header(late), "wrench": pull}
            writer.write_message("/wrench", wrench, message, log_time=ns + 3_000_000)
            roll = {"x": 0.0, "y": 0.0, "z": np.radians(row.tip_angle_deg)}
            message = {"header": _header(ns), "vector": roll}
            writer.write_message("/tip_angle", vector, message, log_time=ns + 3_000_000)
    return path


def _header(ns):
    return {"stamp": {"sec": ns // 10**9, "nanosec": ns % 10**9}, "frame_id": "base"}


def write_json_mcap(folder, table=LAB):
    """One channel of JSON, and one of an encoding that nobody can read."""
    path = folder / "run.mcap"
    with path.open("wb") as file:
        writer = PlainWriter(file)
        writer.start()
        channel = writer.register_channel(topic="/rig", message_encoding="json", schema_id=0)
        other = writer.register_channel(topic="/other", message_encoding="cbor", schema_id=0)
        for i, row in enumerate(table.to_dict("records")):
            ns = 10_000_000 * i
            writer.add_message(channel, ns, json.dumps(row).encode(), ns)
        writer.add_message(other, 0, b"\x00", 0)
        writer.finish()
    return path
