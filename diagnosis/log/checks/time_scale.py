"""The lag of the needle behind its base, compared with that of the nominal needle.

A shaft of torsional rigidity kappa in tissue of damping beta per length, over the length L below a free
length l, follows its base like a first-order lag of

    tau = beta L (4 L / pi^2 + l) / kappa

(slowest mode of diffusion over L, and the free shaft as a spring on the whole damper). If time or
lengths are in another unit, the lag that explains the readings best is far from tau. It is
only trusted if it explains them well and lags near tau do not.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.checks import (
    LAG_DISTINCT,
    LAG_OVER_NOMINAL,
    LAG_UNDER_NOMINAL,
    LAG_UNEXPLAINED,
    LARGE_TURN_DEG,
)
from diagnosis.log.checks.binned_trial import BinnedTrial, binned, lagging
from diagnosis.log.checks.wording import listed
from diagnosis.log.trial import SENSORS, Trial

Array = NDArray[np.float64]

_TIMES = np.concatenate(([0.0], np.logspace(-4, 4, 33)))  # nominal lag


def nominal_lag_s(trial: Trial, rigidity_n_mm2: float, damping: float) -> float:
    """Time by which the nominal needle follows its base, s.

    Args:
      damping: nominal damping, N mm s / rad per mm.
    """
    inserted, free = float(np.median(trial["inserted_mm"])), float(np.median(trial["free_mm"]))
    return damping * inserted * (4 * inserted / np.pi**2 + free) / rigidity_n_mm2


def lag_warnings(trials: Sequence[Trial], rigidity_n_mm2: float, damping: float) -> list[str]:
    """Warnings about trials in which the needle follows far sooner or far later than the nominal one."""
    off: dict[str, tuple[float, float]] = {}
    for trial in trials:
        if trial.tip_is_loaded or not any(trial.has(sensor) for sensor in SENSORS):
            continue
        nominal = nominal_lag_s(trial, rigidity_n_mm2, damping)
        found = _lag_s(binned(trial), nominal)
        if found is not None:
            off[trial.name] = found, nominal
    if not off:
        return []
    first = next(iter(off))
    found, nominal = off[first]
    pace = "far sooner" if found < nominal else "far later"
    return [
        f"{listed(list(off))}: the needle follows base_angle_deg {pace} than the nominal one (in "
        f"{first} by a lag of {found:.2g} s instead of {nominal:.2g} s); check units of time_s (ms: "
        "divide by 1000; minutes: multiply by 60), of inserted_mm and free_mm, and the constants in "
        "rig.yaml"
    ]


def _lag_s(turning: BinnedTrial, nominal_s: float) -> float | None:
    """The observed lag, s, if it is certain and far from the nominal one; else None."""
    if nominal_s <= 0 or np.ptp(turning.base_angle_deg) < LARGE_TURN_DEG:
        return None
    left = np.array([_unexplained(turning, times * nominal_s) for times in _TIMES])
    near = (_TIMES > LAG_UNDER_NOMINAL) & (_TIMES < LAG_OVER_NOMINAL)
    best = int(left.argmin())
    if left[best] > LAG_UNEXPLAINED or left[near].min() < LAG_DISTINCT * max(left[best], 0.01):
        return None
    return float(_TIMES[best]) * nominal_s


def _unexplained(turning: BinnedTrial, lag_s: float) -> float:
    """Share of the variance of the twist, or of the torque, that a lag of the tip leaves."""
    base, tip = turning.base_angle_deg, turning.tip_angle_deg
    copy = lagging(base, lag_s, turning.bin_s)
    wanted = tip if tip.size else turning.base_torque_n_mm
    if not tip.size:
        copy = base - base[0] - copy
    copy, wanted = copy - copy.mean(), wanted - wanted.mean()
    size = float((copy @ copy) * (wanted @ wanted))
    return 1 - max(float(copy @ wanted), 0.0) ** 2 / size if size > 0 else 1.0
