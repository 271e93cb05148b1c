"""Alternative explanations of a gap: how well wrong modelled effects can explain it.

The strength of every effect is fitted to the change that the true effects cause; its other parameters
have typical values. A residual well below sigma (1) means that the log can hardly tell the alternative
from the truth. It is an upper bound, since only the strength is fitted. Pairs scale two fitted effects.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from validation.logs.comparison import RigComparison, rms
from validation.logs.strengths.families import ALL_FAMILIES, FAMILIES, TWO_SIDED, with_effect, without
from validation.logs.strengths.family import ByStrength
from validation.rig.rig import IndependentRig

Array = NDArray[np.float64]
PASSES, CLOSE = 3, 0.03


@dataclass(frozen=True, kw_only=True)
class Alternatives:
    """Rms residual / sigma of each effect alone, best first, and of the best pair of them."""

    alone: dict[str, float]
    pair: tuple[str, ...] = ()
    pair_residual: float = math.inf


def find_alternatives(
    comparison: RigComparison, rig: IndependentRig, names: Sequence[str], among: Sequence[str] = ()
) -> Alternatives:
    """Fit effects (`among`; all by default) to the change that the named ones cause.

    A single true effect is no alternative to itself; one effect of a true pair is an alternative.
    """
    without_them = rig
    for name in names:
        without_them = without(without_them, name)
    target = comparison.difference(rig, without_them)
    fits: dict[str, Array] = {}
    for name in among or FAMILIES:
        if [name] != list(names):
            tried = [_fitted(comparison, rig, without_them, name, by, target) for by in _typical(name)]
            fits[name] = min(tried, key=lambda fit: rms(target - fit))
    alone = sorted((rms(target - fit), name) for name, fit in fits.items())
    pairs = [(_together(target, fits[a], fits[b]), (a, b)) for a, b in combinations(fits, 2)]
    pair_residual, pair = min(pairs, default=(math.inf, ()))
    return Alternatives(
        alone={name: residual for residual, name in alone}, pair=pair, pair_residual=pair_residual
    )


def _typical(name: str) -> list[ByStrength]:
    """Maps from strength to parameters, with the others at a few drawn values."""
    variants = {"tissue_viscoelasticity": 2, "layered_tissue": 2, "stiction": 2, "needle_curvature": 4}
    rng = np.random.default_rng(7)
    return [ALL_FAMILIES[name].draw(rng) for _ in range(variants.get(name, 1))]


def _fitted(
    comparison: RigComparison,
    rig: IndependentRig,
    without_them: IndependentRig,
    name: str,
    by: ByStrength,
    target: Array,
) -> Array:
    """The best fit of a few strengths; each is the last one times its least-squares factor."""
    family = ALL_FAMILIES[name]
    strength = float(np.sqrt(family.low * family.high))
    best = np.zeros_like(target)
    for _ in range(PASSES):
        fitted = target - comparison.difference(rig, with_effect(without_them, name, by(strength)))
        best = fitted if rms(target - fitted) < rms(target - best) else best
        factor = float(np.vdot(fitted, target)) / max(float(np.vdot(fitted, fitted)), 1e-12)
        if abs(factor - 1) < CLOSE or (factor <= 0 and name not in TWO_SIDED):
            break
        strength *= np.sign(factor) * min(max(abs(factor), 0.02), 50.0)
        strength = float(np.sign(strength) * min(max(abs(strength), family.low / 10), family.high))
    return best


def _together(target: Array, one: Array, other: Array) -> float:
    columns = np.stack((one, other))
    gram = columns @ columns.T + 1e-9 * np.eye(2)
    shares = np.clip(np.linalg.solve(gram, columns @ target), -2.0, 2.0)
    return rms(target - shares @ columns)
