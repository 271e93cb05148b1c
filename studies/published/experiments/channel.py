"""The channel that a prebent tip cuts, and the torque with which it holds the tip.

The bent length L lies in the channel that it cut last. With z = exp(i roll), the channel's
orientation C is an average of z over the last travel, of length L,

    dC/ds = (z - C) / L,        C = 0 before anything is cut,

and a rigid channel holds the tip with the torque T Im(z conj(C)): T for a quarter
turn out of a straight channel, 0 in line with it or opposite to it. So a turned tip lags,
and comes free as it cuts further.

The needle in MuJoCo takes a torque at its tip as an input over time. It depends on the roll of
the tip, so run and torque are iterated until they agree.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

from models.errors import InvalidValue
from sim.needles.run import Run, SimulationFailed
from studies.published.criteria import CHANNEL_ITERATIONS, CHANNEL_RELAXATION, CHANNEL_TOLERANCE_N_MM

Array = NDArray[np.float64]

PREBENT_MM = 12.0
"""Section V: the bend is 12 mm from the tip."""


def channel_torque_n_mm(roll_rad: Array, inserted_mm: Array, torque_n_mm: float) -> Array:
    """Torque that resists the tip's roll, N mm, (N,).

    Args:
      roll_rad: roll of the tip, (N,).
      inserted_mm: depth at the same samples, increasing by equal steps, (N,).
      torque_n_mm: T, torque of a quarter turn.

    Raises:
      InvalidValue: the depth does not grow by equal steps.
    """
    steps = np.diff(inserted_mm)
    if not (steps.min() > 0 and np.ptp(steps) < 1e-6):
        raise InvalidValue("inserted_mm", float(steps.min()), "a depth that grows by equal steps")
    z = np.exp(1j * roll_rad)
    kept = float(np.exp(-steps[0] / PREBENT_MM))
    # Exact for a z that runs straight, to second order in a step.
    channel = lfilter([0.5 * (1 - kept), 0.5 * (1 - kept)], [1.0, -kept], z)
    return np.asarray(torque_n_mm * np.imag(z * np.conj(channel)), np.float64)


def run_in_channel(run: Callable[[Array], Run], samples: int, torque_n_mm: float) -> Run:
    """The run whose tip torque is that of the channel that its own tip cuts.

    Args:
      run: simulates a run for a torque at the tip over time, N mm, (samples,).
      torque_n_mm: T, torque of a quarter turn; 0: no channel.

    Raises:
      SimulationFailed: the iteration of torque and run does not converge.
    """
    torque = np.zeros(samples)
    found = run(torque)
    if torque_n_mm == 0.0:
        return found
    for _ in range(CHANNEL_ITERATIONS):
        wanted = channel_torque_n_mm(np.radians(found.tip_deg), found.inputs.inserted_mm, torque_n_mm)
        change = wanted - torque
        if np.abs(change).max() < CHANNEL_TOLERANCE_N_MM:
            return found
        torque = torque + CHANNEL_RELAXATION * change
        found = run(torque)
    raise SimulationFailed(
        f"expected the torque of the channel to settle within {CHANNEL_TOLERANCE_N_MM:g} N mm in "
        f"{CHANNEL_ITERATIONS} iterations, found a change of {np.abs(change).max():.2g} N mm; take "
        "a weaker channel"
    )
