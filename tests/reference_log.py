"""Logs of the independent rig of `reference_rig`, for tests of the diagnosis."""

import numpy as np
import pandas as pd
import yaml
from reference_rig import Rig as ReferenceRig
from reference_rig import simulate as simulate_reference

BETA = 0.0172
TIP, TORQUE, BASE = 0.25, 0.01, 0.02


def motions():
    """Three trials: a fast turn and back, a slow one, one that slides; two depths."""
    fast = ([0, 0.5, 0.9, 3.0, 3.5, 6.0], [0, 0, 90, 90, -20, -20], 100.0, 60.0, 0.0)
    slow = ([0, 1.0, 7.0, 9.0, 12.0], [0, 0, 60, 60, 20], 60.0, 90.0, 0.0)
    slides = ([0, 0.5, 1.1, 5.0], [0, 0, -120, -120], 100.0, 50.0, -2.5)
    return [fast, slow, slides]


# Numerical error of the reference at 60 cells and 10 ms, found by refining both: below 0.02 sigma of
# either sensor, which adds 0.0002 to a gap of 1.
CELLS, STEP_S = 60, 1e-2


def make_log(folder, effects, *, seed=0, damping=BETA):
    rng = np.random.default_rng(seed)
    rig = ReferenceRig(
        diameter_mm=0.59, shear_modulus_gpa=27.2, damping_n_mm_s_per_mm=damping, effects=effects
    )
    folder.mkdir()
    names = []
    for i, (corners, angles, inserted, free, speed) in enumerate(motions()):
        time = np.arange(0, corners[-1], 0.01)
        base = np.interp(time, corners, angles)
        lengths = {
            "inserted_mm": np.full(time.size, inserted),
            "free_mm": free - speed * time,
            "speed_mm_s": np.full(time.size, speed),
        }
        found = simulate_reference(
            rig, time_s=time, base_angle_deg=base, cells=CELLS, dt=STEP_S, **lengths
        )
        table = pd.DataFrame(
            {
                "time_s": time,
                "base_angle_deg": base + rng.normal(0, BASE, time.size),
                "base_torque_n_mm": found.base_torque_n_mm + rng.normal(0, TORQUE, time.size),
                "tip_angle_deg": found.tip_angle_deg + rng.normal(0, TIP, time.size),
                **lengths,
            }
        )
        names.append(f"trial_{i + 1:02d}.csv")
        table.to_csv(folder / names[-1], index=False, float_format="%.5f")
    content = {
        "format": "rig-log/1",
        "needle": {"diameter_mm": 0.59, "shear_modulus_gpa": 27.2, "density_g_cm3": 6.45},
        "tissue": {"damping_n_mm_s_per_mm": BETA},
        "sensors": {
            "tip_angle_noise_deg": TIP,
            "base_torque_noise_n_mm": TORQUE,
            "base_angle_noise_deg": BASE,
        },
        "trials": [{"file": name} for name in names],
    }
    (folder / "rig.yaml").write_text(yaml.safe_dump(content))
    return folder
