"""What else could explain a gap: the best that wrong effects of the vocabulary can do.

Every effect is fitted by its strength to what the true ones change; other parameters take typical
values. A residual well below the noise (1) means that the case can hardly be told from that rival. It
is an upper bound, as rivals are not fitted in full. Pairs add up two fitted effects in proportion.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from validation.logs.comparison import Bench, rms
from validation.rig.rig import Rig
from validation.logs.strengths import FAMILIES, TWO_SIDED, ByStrength, with_effect, without

Array = NDArray[np.float64]
PASSES, CLOSE = 3, 0.03


@dataclass(frozen=True, kw_only=True)
class Rivals:
    """Residual, over the noise, of each effect alone, best first, and of the best pair of them."""

    alone: dict[str, float]
    pair: tuple[str, ...] = ()
    pair_residual: float = math.inf


def find_rivals(bench: Bench, rig: Rig, names: Sequence[str], among: Sequence[str] = ()) -> Rivals:
    """Fit effects (`among`; all by default) to what the named ones change.

    A single effect is not its own rival; of a pair, each one is.
    """
    plain = rig
    for name in names:
        plain = without(plain, name)
    wanted = bench.difference(rig, plain)
    fits: dict[str, Array] = {}
    for name in among or FAMILIES:
        if [name] != list(names):
            tried = [_fitted(bench, rig, plain, name, by, wanted) for by in _typical(name)]
            fits[name] = min(tried, key=lambda fit: rms(wanted - fit))
    alone = sorted((rms(wanted - fit), name) for name, fit in fits.items())
    pairs = [(_together(wanted, fits[a], fits[b]), (a, b)) for a, b in combinations(fits, 2)]
    residual, pair = min(pairs, default=(math.inf, ()))
    return Rivals(alone={name: left for left, name in alone}, pair=pair, pair_residual=residual)


def _typical(name: str) -> list[ByStrength]:
    """Maps from strength to parameters, with the others at a few drawn values."""
    variants = {"tissue_viscoelasticity": 2, "layered_tissue": 2, "stiction": 2, "needle_curvature": 4}
    rng = np.random.default_rng(7)
    return [FAMILIES[name].draw(rng) for _ in range(variants.get(name, 1))]


def _fitted(bench: Bench, rig: Rig, plain: Rig, name: str, by: ByStrength, wanted: Array) -> Array:
    """The best of some strengths, each in proportion to how much of the last one was wanted."""
    family = FAMILIES[name]
    strength = float(np.sqrt(family.low * family.high))
    best = np.zeros_like(wanted)
    for _ in range(PASSES):
        got = wanted - bench.difference(rig, with_effect(plain, name, by(strength)))
        best = got if rms(wanted - got) < rms(wanted - best) else best
        factor = float(np.vdot(got, wanted)) / max(float(np.vdot(got, got)), 1e-12)
        if abs(factor - 1) < CLOSE or (factor <= 0 and name not in TWO_SIDED):
            break
        strength *= np.sign(factor) * min(max(abs(factor), 0.02), 50.0)
        strength = float(np.sign(strength) * min(max(abs(strength), family.low / 10), family.high))
    return best


def _together(wanted: Array, one: Array, other: Array) -> float:
    columns = np.stack((one, other))
    gram = columns @ columns.T + 1e-9 * np.eye(2)
    shares = np.clip(np.linalg.solve(gram, columns @ wanted), -2.0, 2.0)
    return rms(wanted - shares @ columns)
