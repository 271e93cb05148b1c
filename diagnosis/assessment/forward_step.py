"""Forward steps: how much each further effect would improve an explanation.

Real rigs have three to five effects at once, and a library holds few of them. If a search ends
with fewer than three and explains nothing, the nearest explanation is extended by one effect at a
time, the most promising one, as long as it removes a good share of the residual. It does not go down
to the noise: such a fit would most likely be imitation, since the search would have found it otherwise.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from diagnosis.criteria.assessment import MOST_OF_NEAREST, STEP_LEAVES
from diagnosis.fitting.fit import Fit, fit_effects
from diagnosis.fitting.noise_floor import floor_of
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.screening import Screened, screen
from diagnosis.workers import Failure, Task, Workers, attempt

_ITERATIONS = 3
_STARTS = 2


def on_decimated(coarse: FitProblem, best: Fit) -> Fit:
    """The best fit, repeated on the decimated log.

    Raises:
      SimulationFailed: it cannot be simulated with the coarse needle.
    """
    start = coarse.parameterization(best.names).joined(best.parts)
    return fit_effects(coarse, best.names, start, most_iterations=_ITERATIONS)


def has_room(best: Fit) -> bool:
    """Whether one more effect could take a good share off the cost, a part of which is noise."""
    return len(best.names) < MOST_OF_NEAREST and STEP_LEAVES * best.cost > best.samples


@dataclass(frozen=True, kw_only=True, eq=False)
class Further:
    """The best fit on the decimated log, and each further effect beside it.

    Attributes:
      base: the best fit, repeated on the decimated log.
      screened: every effect that it does not have, at its best start.
    """

    base: Fit
    screened: tuple[Screened, ...]


def further_effects(
    coarse: FitProblem, best: Fit, effects: Sequence[str], workers: Workers
) -> Further | Failure:
    """Each further effect beside the best fit; a failure if that cannot be repeated when decimated."""
    base = attempt(on_decimated, Task(effects=best.names, arguments=(coarse, best)))
    if isinstance(base, Failure):
        return base
    return Further(base=base, screened=_one_more(coarse, base, effects, workers))


def gap_with_one_more(gap: float, further: Further) -> dict[str, float]:
    """What the gap of the best fit may become with one more effect, by effect, smallest first."""
    base = further.base
    samples = max(base.samples, 1)
    # The floor of the decimated log is not exactly that of the log: ratios carry over.
    scale = gap / np.sqrt(base.cost / samples) if base.cost > 0 else 1.0
    left = {s.names[-1]: float(scale * np.sqrt(s.cost / samples)) for s in further.screened}
    return dict(sorted(left.items(), key=lambda item: item[1]))


def forward_selection(
    problem: FitProblem,
    coarse: FitProblem,
    best: Fit,
    further: Further,
    effects: Sequence[str],
    workers: Workers,
) -> Fit:
    """The best fit with further effects, added while each removes a good share of the cost.

    Args:
      problem: the log itself; coarse: the decimated log.
      further: each further effect beside the best.
    """
    while len(best.names) < MOST_OF_NEAREST:
        base = further.base
        promising = min(further.screened, key=lambda s: s.cost, default=None)
        if promising is None or promising.cost > STEP_LEAVES * base.cost:
            break
        arguments = (coarse, promising.names, promising.start)
        wider = attempt(fit_effects, Task(effects=promising.names, arguments=arguments))
        if isinstance(wider, Failure) or wider.cost > STEP_LEAVES * base.cost:
            break
        refit = partial(fit_effects, most_iterations=_ITERATIONS)
        found = attempt(refit, Task(effects=wider.names, arguments=(problem, wider.names, wider.x)))
        if isinstance(found, Failure) or found.cost > STEP_LEAVES * best.cost:
            break
        if floor_of(found.by_trial).small:
            break
        best = found
        if len(best.names) < MOST_OF_NEAREST:
            further = Further(base=wider, screened=_one_more(coarse, wider, effects, workers))
    return best


def _one_more(
    coarse: FitProblem, base: Fit, effects: Sequence[str], workers: Workers
) -> tuple[Screened, ...]:
    """Screening of all further effects on top of a fit."""
    tasks = [
        Task(effects=(name,), arguments=(coarse, base, name, _STARTS))
        for name in effects
        if name not in base.names
    ]
    results = workers.each("adding another effect", screen, tasks)
    return tuple(found[0] for found in results if not isinstance(found, Failure))
