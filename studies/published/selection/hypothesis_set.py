"""Which hypotheses are held to the published figures.

The stated rig in both readings of its free length. Every candidate alone in the reading of
the set-up, and those that the paper's text gives reason to suspect in that of the model.
Pairs of suspects; in the model's reading, whose needle is too quick at 5 cm as it is,
those with the base's motion in them. And the leading single candidate with every other
that does anything alone. In gelatin, of which four figures are printed, single effects.
"""

from collections.abc import Sequence
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from studies.published.experiments.rig import SETUP_FREE_MM, PaperRig
from studies.published.fitting.fit import Fit
from studies.published.fitting.hypothesis import Hypothesis
from studies.published.fitting.mechanisms import (
    BASE_RAMP,
    BASE_SERVO,
    CANDIDATES,
    DAMPING,
    FREE_LENGTH,
    OF_GELATIN,
)

Array = NDArray[np.float64]

READINGS = (PaperRig(free_mm=SETUP_FREE_MM), PaperRig(free_mm=0.0))
# What the paper's own text gives reason to suspect.
_MOTIONS = {BASE_RAMP.name, BASE_SERVO.name}
SUSPECTS = (
    FREE_LENGTH.name,
    BASE_RAMP.name,
    BASE_SERVO.name,
    "speed_dependent_friction",
    "coulomb_friction",
    "shear_thinning",
    "tissue_viscoelasticity",
)


def stated(base: PaperRig) -> Hypothesis:
    """What the paper states, nothing fitted."""
    return Hypothesis(names=(), base=base, candidates=())


def of_plastisol(base: PaperRig, *names: str) -> Hypothesis:
    """Candidates by name in one reading; the damping goes with them."""
    candidates = (DAMPING, *(CANDIDATES[n] for n in names if n != DAMPING.name))
    return Hypothesis(names=names, base=base, candidates=candidates)


def of_gelatin(name: str) -> Hypothesis:
    """One effect in gelatin, of which the paper states no damping: the plastisol's stands."""
    return Hypothesis(names=(name,), base=PaperRig(), candidates=(OF_GELATIN[name],))


def singles() -> list[Hypothesis]:
    """The damping and every candidate alone; in the model's reading, the suspects alone."""
    setup, model = READINGS
    alone = [(setup, n) for n in (DAMPING.name, *CANDIDATES)]
    alone += [(model, n) for n in (DAMPING.name, *SUSPECTS)]
    return [of_plastisol(base, name) for base, name in alone if _possible(base, (name,))]


def pairs(alone: Sequence[Fit]) -> list[Hypothesis]:
    """Pairs worth fitting.

    Args:
      alone: fits of `singles`.
    """
    setup, model = READINGS
    suspects = list(combinations(SUSPECTS, 2))
    wanted: list[tuple[PaperRig, tuple[str, ...]]] = [(setup, pair) for pair in suspects]
    wanted += [(model, pair) for pair in suspects if _MOTIONS & set(pair)]
    leading = min(alone, key=lambda f: f.aicc).hypothesis
    damping = next(f for f in alone if f.hypothesis.names == (DAMPING.name,))
    wanted += [
        (leading.base, (*leading.names, *f.hypothesis.names))
        for f in alone
        if f.aicc < damping.aicc and f.hypothesis.names[0] not in (DAMPING.name, *SUSPECTS)
    ]
    return [of_plastisol(base, *pair) for base, pair in wanted if _possible(base, pair)]


def _possible(base: PaperRig, names: tuple[str, ...]) -> bool:
    """A rig has one motion of its base; and no free length is none to fit."""
    return not set(names) >= _MOTIONS and (base.free_mm > 0 or FREE_LENGTH.name not in names)


def starts_alone(one: Hypothesis, damping: Fit) -> list[Array]:
    """Where the fit of one candidate starts: at the damping fitted alone, too."""
    own = one.starts()
    return [*own, *(np.concatenate([damping.x, x[1:]]) for x in own)]


def starts_of_pair(pair: Hypothesis, alone: dict[str, Fit]) -> list[Array]:
    """Where the fit of a pair starts: the better single fit, joined to the other's fit and starts.

    Args:
      alone: fits of single candidates in the reading of the pair, by name, as far as known;
        of the pair at least one.
    """
    leader = min((n for n in pair.names if n in alone), key=lambda n: alone[n].chi_square)
    other = next(n for n in pair.names if n != leader)
    joins = [alone[other].x] if other in alone else []
    joins += of_plastisol(pair.base, other).starts()
    mine = alone[leader].x
    if leader == pair.names[0]:
        return [np.concatenate([mine, x[1:]]) for x in joins]
    return [np.concatenate([mine[:1], x[1:], mine[1:]]) for x in joins]
