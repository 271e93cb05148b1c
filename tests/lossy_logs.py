"""Small logs with dry friction, whose encoder of the base scatters and loses counts."""

from dataclasses import replace

import numpy as np
from diagnosis_fixtures import joined, log_of, turns

from diagnosis.replay.rig_parameters import RigParameters

BASE, AT, LOST_DEG = "base_angle_deg", 650, 0.4
DRY = RigParameters(kinetic_n_mm_per_mm=0.002)
NAMES = ("coulomb_friction",)
ENCODER_DEG = 0.02


def read(lost_deg=0.0, turned_deg=0.0):
    """Two trials with dry friction; the encoder scatters, and loses counts in the second.

    Args:
      turned_deg: what the shaft itself turns by at that moment.
    """
    rng, angle = np.random.default_rng(5), turns(8.0)
    stepped = angle + turned_deg * (np.arange(angle.size) >= AT)
    trials = []
    for one in joined(log_of(DRY, angle=angle), log_of(DRY, angle=stepped, seed=1)).trials:
        noisy = one[BASE] + rng.normal(0.0, ENCODER_DEG, angle.size)
        trials.append(replace(one, table=one.table.assign(**{BASE: noisy})))
    lost = trials[1][BASE] + lost_deg * (np.arange(angle.size) >= AT)
    trials[1] = replace(trials[1], table=trials[1].table.assign(**{BASE: lost}))
    return replace(joined(), trials=tuple(trials))
