"""Which hypotheses are fitted to the published figures.

Single mechanisms: all with the set-up's free length; those that the paper's text gives
reason to suspect, also without free length. Pairs: all pairs of suspects (without free length,
where the needle is too quick at 5 cm already, only those with the base's own motion), and the
best single mechanism with every other that improves AICc. For gelatin, of which
four figures are printed, single effects only.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations

from studies.published.experiments.rig import WITH_FREE_LENGTH, WITHOUT_FREE_LENGTH, PublishedRig
from studies.published.fitting.fit import FigureFit
from studies.published.fitting.hypothesis import Hypothesis, of_gelatin, of_plastisol
from studies.published.fitting.mechanisms import (
    BASE_RAMP,
    BASE_SERVO,
    DAMPING,
    FREE_LENGTH,
    OF_GELATIN,
    OF_PLASTISOL,
)

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
"""What the paper's own text gives reason to suspect."""


def singles() -> list[Hypothesis]:
    """The damping and every mechanism alone; without free length, the suspects alone."""
    alone = [(WITH_FREE_LENGTH, n) for n in (DAMPING.name, *OF_PLASTISOL)]
    alone += [(WITHOUT_FREE_LENGTH, n) for n in (DAMPING.name, *SUSPECTS)]
    return [of_plastisol(base, name) for base, name in alone if _possible(base, (name,))]


def pairs(alone: Sequence[FigureFit]) -> list[Hypothesis]:
    """Pairs worth fitting.

    Args:
      alone: fits of single mechanisms, that of the damping among them.
    """
    suspects = list(combinations(SUSPECTS, 2))
    wanted: list[tuple[PublishedRig, tuple[str, ...]]] = [(WITH_FREE_LENGTH, p) for p in suspects]
    wanted += [(WITHOUT_FREE_LENGTH, p) for p in suspects if _MOTIONS & set(p)]
    leading = min(alone, key=lambda f: f.aicc).hypothesis
    damping = next(f for f in alone if f.hypothesis.names == (DAMPING.name,))
    wanted += [
        (leading.base, (*leading.names, *f.hypothesis.names))
        for f in alone
        if f.aicc < damping.aicc and f.hypothesis.names[0] not in (DAMPING.name, *SUSPECTS)
    ]
    return [of_plastisol(base, *pair) for base, pair in wanted if _possible(base, pair)]


def _possible(base: PublishedRig, names: tuple[str, ...]) -> bool:
    """Whether a pair makes sense: a rig has one base motion, and free length needs a rig with some."""
    return not set(names) >= _MOTIONS and (base.free_mm > 0 or FREE_LENGTH.name not in names)


@dataclass(frozen=True, kw_only=True)
class HypothesisSet:
    """The hypotheses of a study.

    Attributes:
      plastisol: single mechanisms, the damping first.
      pairs: returns the pairs for plastisol, given the fits of single mechanisms.
      gelatin: single effects.
    """

    plastisol: tuple[Hypothesis, ...]
    pairs: Callable[[Sequence[FigureFit]], list[Hypothesis]]
    gelatin: tuple[Hypothesis, ...]


ALL_HYPOTHESES = HypothesisSet(
    plastisol=tuple(singles()), pairs=pairs, gelatin=tuple(map(of_gelatin, OF_GELATIN))
)
