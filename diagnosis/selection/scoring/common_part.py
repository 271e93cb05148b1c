"""What the residuals of tip and torque have in common: noise of two sensors has nothing.

A law that a model lacks shows in both, as most do that act on the needle. Whitened residuals are
averaged over blocks of a second, so that a part that is slow counts; of noise, these means are
independent, and their correlation over N blocks scatters by 1 / sqrt(N).
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from diagnosis.fitting.fit import Fit
from diagnosis.fitting.noise_reestimation import by_trial_and_sensor
from diagnosis.fitting.problem import FitProblem

Array = NDArray[np.float64]

_BLOCK_S = 1.0
_FEWEST = 10  # readings of either sensor in a block


def common_part(problem: FitProblem, fit: Fit) -> float:
    """Correlation of what a fit leaves of tip and torque, in standard deviations; 0: not both read."""
    pairs = list(_means(problem, fit))
    if not pairs:
        return 0.0
    one, other = np.hstack(pairs)
    size = float(np.sqrt((one @ one) * (other @ other)))
    return float(one @ other) / size * float(np.sqrt(one.size)) if size else 0.0


def _means(problem: FitProblem, fit: Fit) -> Iterator[Array]:
    """Means of both sensors in the blocks of each trial that has both, (2, B)."""
    for parts in by_trial_and_sensor(problem, fit.by_trial):
        if len(parts) == 2:
            read = [time_s for _, time_s, _ in parts if time_s.size]
            begin_s, end_s = min(own[0] for own in read), max(own[-1] for own in read)
            edges = np.arange(begin_s, end_s + _BLOCK_S, _BLOCK_S)
            count = np.array([np.histogram(time_s, edges)[0] for _, time_s, _ in parts])
            total = np.array([np.histogram(t, edges, weights=v)[0] for _, t, v in parts])
            known = (count >= _FEWEST).all(axis=0)
            yield total[:, known] / np.sqrt(count[:, known])
