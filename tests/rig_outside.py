"""Short logs of the independent rig of `validation`, with effects that the library does not have."""

import numpy as np
import pandas as pd
from diagnosis_fixtures import BASE, TIP, TORQUE, log_with

from diagnosis.log.trial import Trial
from validation.rig.motion import TrialMotion
from validation.rig.rig import IndependentRig
from validation.rig.simulation import COARSE, ideal_signals

FINE_S, PER_SAMPLE = 0.005, 4
TURNS = (
    ([0, 0.4, 0.9, 1.8, 2.3, 3.2, 4.0], [0, 0, 90, 90, 0, 0, 90]),
    ([0, 0.4, 1.8, 2.2, 4.0], [0, 0, 60, 60, -30]),
)


def motion(corners_s, angles_deg):
    """A trial 90 mm deep, at rest along the axis."""
    time = np.arange(0, corners_s[-1] + 1e-9, FINE_S)
    return TrialMotion(
        dt_s=FINE_S,
        per_sample=PER_SAMPLE,
        base_deg=np.interp(time, corners_s, angles_deg),
        inserted_mm=np.full(time.size, 90.0),
        free_mm=np.full(time.size, 60.0),
        speed_mm_s=np.zeros(time.size),
    )


def log_outside(outside, *, seed=1):
    """Two trials of 4 s at 50 Hz, of a rig that the nominal one does not know all of."""
    rng = np.random.default_rng(seed)
    rig = IndependentRig(damping_n_mm_s_per_mm=0.0172, outside=outside)
    trials = []
    for i, turned in enumerate(TURNS, start=1):
        own = motion(*turned)
        read, kept = ideal_signals(rig, own, COARSE), own.recorded
        size = read.time_s[kept].size
        table = pd.DataFrame(
            {
                "time_s": read.time_s[kept],
                "base_angle_deg": read.base_deg[kept] + rng.normal(0, BASE, size),
                "tip_angle_deg": read.tip_deg[kept] + rng.normal(0, TIP, size),
                "base_torque_n_mm": read.torque_n_mm[kept] + rng.normal(0, TORQUE, size),
                "inserted_mm": own.inserted_mm[kept],
                "free_mm": own.free_mm[kept],
                "speed_mm_s": own.speed_mm_s[kept],
            }
        )
        trials.append(Trial(name=f"trial_{i:02d}.csv", table=table))
    return log_with(*trials)
