"""Readings of a loaded tip beyond the tissue, which a replay does not simulate.

Where the needle slides through its tissue, shaft comes out at the far side. A torque T at the tip twists
that as well: by T l / kappa over a length l, of which a log tells how much it changes, not how long it
is. So readings of the tip that this turns by more than a part of the noise are not used.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import median_filter

from diagnosis.criteria.checks import LENGTH_SLACK, LENGTH_SLACK_MM
from diagnosis.criteria.faults import TWIST_BEYOND_SIGMA
from diagnosis.log.checks.travel import travelled_mm
from diagnosis.log.checks.wording import lines
from diagnosis.log.faults.scatter import scatter
from diagnosis.log.trial import TIP, Trial

Array = NDArray[np.float64]

_ROWS = 5  # whose middle one is a length: one row alone may be off


def without_twist_beyond(
    trial: Trial, rigidity_n_mm2: float, noise_deg: float
) -> tuple[Trial, list[str]]:
    """The trial without such readings, in memory, and a warning if there are any.

    Args:
      rigidity_n_mm2: nominal torsional rigidity.
      noise_deg: claimed noise of the tip's angle.
    """
    if not (trial.tip_is_loaded and trial.has(TIP) and (out_mm := _out_mm(trial)).any()):
        return trial, []
    torque = np.nan_to_num(trial["tip_torque_n_mm"])
    twist_deg = np.degrees(np.abs(torque) * out_mm / rigidity_n_mm2)
    sigma_deg = max(noise_deg, scatter(trial[TIP]))
    rows = (twist_deg > TWIST_BEYOND_SIGMA * sigma_deg) & np.isfinite(trial[TIP])
    if not rows.any():
        return trial, []
    table = trial.table.assign(**{TIP: np.where(rows, np.nan, trial[TIP])})
    return replace(trial, table=table), [
        f"{trial.name}: free_mm and inserted_mm together change by {out_mm.max():.3g} mm, so that shaft "
        f"is beyond the tissue; the torque at the tip twists it, by {twist_deg.max():.2g} deg or more, "
        f"which is not simulated; tip_angle_deg is not used in {rows.sum()} of {rows.size} samples, "
        f"{lines(rows)}: load the tip in trials where it stays in the tissue"
    ]


def _out_mm(trial: Trial) -> Array:
    """Length of shaft beyond the tissue, as far as a trial tells, (N,); 0 if it stays in it.

    While the needle is outside, the free length is that to the tissue, and tells nothing of the shaft.
    """
    whole, inside = trial["free_mm"] + trial["inserted_mm"], trial["inserted_mm"] > 0
    if not inside.any():
        return np.zeros_like(whole)
    shaft_mm = float(median_filter(whole[inside], _ROWS, mode="nearest").max())
    slack_mm = LENGTH_SLACK_MM + LENGTH_SLACK * float(np.ptp(travelled_mm(trial)))
    out = np.where(inside, np.clip(shaft_mm - whole, 0.0, None), 0.0)
    return out if out.max() > slack_mm else np.zeros_like(out)
