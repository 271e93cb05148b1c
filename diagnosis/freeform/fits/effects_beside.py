"""Which effects of the library are worth a fit beside a free-form law, if no law alone closes the gap.

By a linear model of all laws and all effects at once. With J the slopes of a law's fit, r what that
leaves, and d what an effect at a start changes of the readings without the law,

    predicted cost = min over x and a >= 0 of |r + J x + a d|^2,

which takes no simulation. The effects of the pairs that promise most
are then simulated beside their laws (selection.screening), since both may be far from small.
"""

from collections.abc import Sequence
from itertools import islice
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diagnosis.fitting.fit import Fit
from diagnosis.fitting.parameterization import starts
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.fits.free_fit import FreeFit, few_of_each, with_family
from diagnosis.freeform.fits.linear_model import linear_model
from diagnosis.selection.screening import Screened, screen
from diagnosis.workers import Failure, Task, Workers

Array = NDArray[np.float64]

SCREENING_ALONE, SCREENING_BESIDE = (
    "screening effects without a law",
    "screening effects beside a free-form law",
)
STARTS = 2  # of an effect that is looked at
SIMULATED, SIMULATED_OF_ONE = 24, 4  # pairs in all, and of one law
PAIRS, PAIRS_OF_ONE = 6, 2  # that go on
MOST = 3.0  # times its start, that an effect is taken for


def pairs_beside(
    coarse: FitProblem,
    rough: FitProblem,
    base: Fit,
    laws: Sequence[FreeFit],
    effects: Sequence[str],
    workers: Workers,
) -> list[tuple[FreeFit, Screened]]:
    """Laws with an effect beside each that could leave least, best first.

    Args:
      coarse: the decimated log.
      rough: the same for a rougher needle.
      base: its fit without law and effect.
      laws: the fits of laws alone.
    """
    pairs = _promising(rough, base, laws, effects, workers)
    tasks = [Task(effects=(name,), arguments=(coarse, law, name)) for law, name in pairs]
    each = zip(pairs, workers.each(SCREENING_BESIDE, _screened_beside, tasks), strict=True)
    found = [(law, s) for (law, _), s in each if not isinstance(s, Failure)]
    ranked = sorted(found, key=lambda pair: pair[1].cost)
    return list(islice(few_of_each(ranked, _law_of, PAIRS_OF_ONE), PAIRS))


def _promising(
    rough: FitProblem,
    base: Fit,
    laws: Sequence[FreeFit],
    effects: Sequence[str],
    workers: Workers,
) -> list[tuple[FreeFit, str]]:
    """The pairs that the linear model promises most of."""
    tasks = [Task(effects=(name,), arguments=(rough, base, name)) for name in effects]
    each = zip(effects, workers.each(SCREENING_ALONE, _changes, tasks), strict=True)
    known = {name: rows for name, rows in each if not isinstance(rows, Failure)}
    if not known:
        return []
    changes = np.hstack(list(known.values()))
    owners = np.repeat(list(known), [rows.shape[1] for rows in known.values()])
    predicted = []
    for law in laws:
        costs = predicted_costs(law.fit, changes)
        least = {name: float(costs[owners == name].min()) for name in known}
        predicted += [(cost, law, name) for name, cost in least.items()]
    ranked = [(law, name) for _, law, name in sorted(predicted, key=lambda one: one[0])]
    return list(islice(few_of_each(ranked, _law_of, SIMULATED_OF_ONE), SIMULATED))


def _law_of(pair: tuple[FreeFit, Any]) -> FreeFit:
    return pair[0]


def _changes(rough: FitProblem, base: Fit, name: str) -> Array:
    """What an effect at its starts changes of the residuals without a law, (N, starts)."""
    parameterization = rough.parameterization((*base.names, name))
    each = [base.parts | {name: start} for start in starts(rough.library[name])[:STARTS]]
    rigs = [parameterization.rig(parameterization.joined(parts)) for parts in each]
    runs = rough.residuals(rigs, callback_alone=True)
    return np.concatenate(
        [np.stack(run, axis=1) - was[:, None] for run, was in zip(runs, base.by_trial, strict=True)]
    )


def predicted_costs(law: Fit, changes: Array) -> Array:
    """The cost that each change, (N, k), could leave beside a law, (k,)."""
    model = linear_model(law)
    squares, along = model.beyond(changes)
    size = np.maximum(np.diag(squares), 1e-12)
    amount = np.clip(-along / size, 0.0, MOST)
    return np.asarray(model.cost + 2.0 * amount * along + amount**2 * size)


def _screened_beside(coarse: FitProblem, law: FreeFit, name: str) -> Screened:
    return screen(with_family(coarse, law.family), law.fit, name, STARTS)[0]
