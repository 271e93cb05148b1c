"""A good log that is analytic, and changes to it: for tests of reading.

The tip follows the base with a first-order lag, the torque is a spring between the two. White noise as
claimed is added, so that it scatters.
"""

import numpy as np
import pandas as pd
import pytest
import yaml

from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.trial import UnusableLog

TIP, TORQUE, BASE = 0.4, 0.015, 0.02
SPRING_N_MM_PER_DEG = 0.04  # about kappa of the nominal needle over 140 mm
STEP_S = 0.01


def behind(base, lag_s):
    """What a first-order lag makes of samples."""
    tip = np.zeros(base.size)
    for i in range(1, base.size):
        tip[i] = tip[i - 1] + STEP_S / lag_s * (base[i] - tip[i - 1])
    return tip


def table(*, corners_s, angles_deg, speed_mm_s, lag_s, seed):
    """A trial of 100 rows a second."""
    rng = np.random.default_rng(seed)
    at = np.arange(0, corners_s[-1], STEP_S)
    base = np.interp(at, corners_s, angles_deg)
    tip = behind(base, lag_s)
    exact = {
        "time_s": at,
        "base_angle_deg": base + rng.normal(0, BASE, at.size),
        "base_torque_n_mm": SPRING_N_MM_PER_DEG * (base - tip) + rng.normal(0, TORQUE, at.size),
        "tip_angle_deg": tip + rng.normal(0, TIP, at.size),
        "inserted_mm": np.full(at.size, 100.0),
        "free_mm": 70.0 - speed_mm_s * at,
        "speed_mm_s": np.full(at.size, speed_mm_s),
    }
    return pd.DataFrame(exact).round(4)


CORNERS = {"corners_s": [0, 1, 2, 6, 7, 12], "angles_deg": [0, 0, 90, 90, -30, -30]}
TURNS = table(**CORNERS, speed_mm_s=0, lag_s=0.5, seed=1)
SLIDES = table(corners_s=[0, 1, 2, 8], angles_deg=[0, 0, -120, -120], speed_mm_s=-2.5, lag_s=0.8, seed=2)
RIG = {
    "format": "rig-log/1",
    "needle": {"diameter_mm": 0.59, "shear_modulus_gpa": 27.2, "density_g_cm3": 6.45},
    "tissue": {"damping_n_mm_s_per_mm": 0.017},
    "sensors": {
        "tip_angle_noise_deg": TIP,
        "base_torque_noise_n_mm": TORQUE,
        "base_angle_noise_deg": BASE,
    },
    "trials": [{"file": "turns.csv"}, {"file": "slides.csv"}],
}


def write_log(folder):
    folder.mkdir()
    TURNS.to_csv(folder / "turns.csv", index=False)
    SLIDES.to_csv(folder / "slides.csv", index=False)
    (folder / "rig.yaml").write_text(yaml.safe_dump(RIG))
    return folder


def change_trial(folder, change, name="turns.csv"):
    path = folder / name
    change(pd.read_csv(path)).to_csv(path, index=False)


def change_text(folder, change, name="turns.csv"):
    path = folder / name
    path.write_text(change(path.read_text()))


def change_rig(folder, change):
    content = yaml.safe_load((folder / "rig.yaml").read_text())
    change(content)
    (folder / "rig.yaml").write_text(yaml.safe_dump(content))


def refusal(folder):
    with pytest.raises(UnusableLog) as caught:
        read_rig_log(folder)
    return str(caught.value)


def at(column, **rows):
    """Set some rows of a column: `at("tip_angle_deg", r5=3.0)`."""

    def change(t):
        t[column] = t[column].astype(object)
        for row, value in rows.items():
            t.loc[int(row[1:]), column] = value
        return t

    return change


def scaled(column, factor):
    return lambda t: t.assign(**{column: factor * t[column]})


def swapped(one, other):
    return lambda t: t.rename(columns={one: other, other: one})


def renamed(old, new):
    return lambda t: t.rename(columns={old: new})


def late(values, rows):
    return np.concatenate((values[:rows], values[:-rows]))


def lagging(base, lag_s):
    return table(corners_s=base[0], angles_deg=base[1], speed_mm_s=0, lag_s=lag_s, seed=3)


def frozen(column, first=300, count=150):
    def change(t):
        t.loc[first : first + count - 1, column] = t.loc[first, column]
        return t

    return change
