"""Small sets of columns that add up to a target, beside what scatters anyway: linear algebra alone.

Of all sets of at most three columns those are found whose combination leaves little of a target t:

    left = |t|^2 - b' G^-1 b,    G = C' C,    b = C' t,

with columns C and t orthogonal to the nuisance, whose prior stands in rows of its own. G is taken
once; a set needs a small part of it.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.selection import EQUIVALENT_PART

Array = NDArray[np.float64]

_RIDGE = 1e-10  # on the diagonal of G, relative: two equal columns share


@dataclass(frozen=True, kw_only=True, eq=False)
class Combination:
    """A set of columns.

    Attributes:
      columns: which.
      amounts: of each.
      cost: sum of squares of the target that they do not explain.
    """

    columns: tuple[int, ...]
    amounts: Array
    cost: float


def beside(nuisance: Array, weights: Array, columns: Array) -> Array:
    """Columns, (N, m), less what nuisance, (N, k), takes over at the cost of its prior: (N + k, m)."""
    basis, _ = np.linalg.qr(np.vstack([nuisance, np.diag(weights)]))
    padded = np.vstack([columns, np.zeros((weights.size, columns.shape[1]))])
    return np.asarray(padded - basis @ (basis.T @ padded))


def combinations_within(
    target: Array, columns: Array, one_sided: NDArray[np.bool_], most: int, allowed: float
) -> list[Combination]:
    """Sets of at most so many columns that leave no more than `allowed` of the target.

    Args:
      one_sided: columns, (m,), whose amount cannot be negative.

    Returns:
      smallest sets first, among these what leaves least; none that explains the target hardly
      better than a smaller part of it.
    """
    gram, seen, power = columns.T @ columns, columns.T @ target, float(target @ target)
    gram = gram + np.diag(_RIDGE * np.diag(gram) + np.finfo(float).tiny)
    least: dict[tuple[int, ...], float] = {(): power}
    found = []
    for size in range(1, most + 1):
        sets = np.array(list(combinations(range(columns.shape[1]), size)), int).reshape(-1, size)
        parts = gram[sets[:, :, None], sets[:, None, :]]
        amounts = np.linalg.solve(parts, seen[sets][..., None])[..., 0]
        left = np.maximum(power - np.einsum("ij,ij->i", amounts, seen[sets]), 0.0)
        possible = ~((amounts < 0) & one_sided[sets]).any(axis=1)
        for own, amount, rest, can in zip(map(tuple, sets), amounts, left, possible, strict=True):
            before = min(least[part] for part in _parts(own))
            least[own] = min(float(rest), before) if can else before
            if can and rest <= allowed and rest <= EQUIVALENT_PART * before:
                found.append(Combination(columns=own, amounts=amount, cost=float(rest)))
    return sorted(found, key=lambda one: (len(one.columns), one.cost))


def _parts(columns: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
    """The sets with one column less."""
    for i in range(len(columns)):
        yield columns[:i] + columns[i + 1 :]
