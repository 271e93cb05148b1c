"""A forward step: what each further effect would add to an explanation, on the decimated log."""

from collections.abc import Sequence

import numpy as np

from diagnosis.fitting.fit import Fit, fit_effects
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.screening import screen
from diagnosis.workers import Failure, Task, Workers

_ITERATIONS = 3
_STARTS = 2


def on_decimated(coarse: FitProblem, best: Fit) -> Fit:
    """The best fit, once more on the decimated log.

    Raises:
      SimulationFailed: it cannot be simulated so coarsely.
    """
    start = coarse.parameterization(best.names).joined(best.parts)
    return fit_effects(coarse, best.names, start, most_iterations=_ITERATIONS)


def gap_with_one_more(
    coarse: FitProblem, best: Fit, base: Fit, effects: Sequence[str], workers: Workers
) -> dict[str, float]:
    """Gap that the best fit may come down to with one more effect, least first.

    Args:
      base: the best fit on the decimated log.
    """
    tasks = [
        Task(effects=(name,), arguments=(coarse, base, name, _STARTS))
        for name in effects
        if name not in base.names
    ]
    results = workers.each("adding another effect", screen, tasks)
    screened = [found[0] for found in results if not isinstance(found, Failure)]
    samples = max(base.samples, 1)
    # The floor of the decimated log is not exactly that of the log: ratios carry over.
    scale = best.gap / np.sqrt(base.cost / samples) if base.cost > 0 else 1.0
    left = {s.names[-1]: float(scale * np.sqrt(s.cost / samples)) for s in screened}
    return dict(sorted(left.items(), key=lambda item: item[1]))
