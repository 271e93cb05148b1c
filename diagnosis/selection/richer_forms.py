"""Forms of a richer effect about the simpler one that it contains, as vectors of a fit."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects import FITTED
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.candidate import Candidate

Array = NDArray[np.float64]


def with_richer(one: Candidate, simple: str, rich: str) -> tuple[str, ...]:
    """Effects of a candidate, a richer one in place of a simple one."""
    return tuple(rich if name == simple else name for name in one.names)


def overlap(name: str, others: Sequence[str]) -> bool:
    """Whether an effect is among others, contains one, or is contained in one: it adds nothing new."""
    return any(name == o or name in FITTED[o].contains or o in FITTED[name].contains for o in others)


def forms_beyond(problem: FitProblem, one: Candidate, simple: str, rich: str) -> list[Array]:
    """Typical forms of the richer effect, everything else as in the candidate: vectors of its fit."""
    values = [
        p.from_fit(float(v))
        for p, v in zip(problem.library[simple].parameters, one.fit.parts[simple], strict=True)
    ]
    effect, parameterization = (
        problem.library[rich],
        problem.parameterization(with_richer(one, simple, rich)),
    )
    found = []
    for form in effect.contains[simple](*values):
        own = np.array([p.to_fit(v) for p, v in zip(effect.parameters, form, strict=True)])
        found.append(parameterization.joined({**one.fit.parts, rich: own}))
    return found
