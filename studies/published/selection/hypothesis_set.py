"""Which hypotheses are fitted to the published figures.

Every mechanism alone with the set-up's free length, and those that the paper's text gives
reason to suspect without free length too. Pairs of suspects; without free length, where the
needle is too quick at 5 cm as it is, those with the base's own motion among them. And the
leading single mechanism with every other that improves AICc at all. In gelatin, of which
four figures are printed, single effects.
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
    """A rig has one motion of its base; and without free length there is none to fit."""
    return not set(names) >= _MOTIONS and (base.free_mm > 0 or FREE_LENGTH.name not in names)


@dataclass(frozen=True, kw_only=True)
class HypothesisSet:
    """The hypotheses of a study.

    Attributes:
      plastisol: single mechanisms, the damping first.
      pairs: of plastisol, given the fits of the single ones.
      gelatin: single effects.
    """

    plastisol: tuple[Hypothesis, ...]
    pairs: Callable[[Sequence[FigureFit]], list[Hypothesis]]
    gelatin: tuple[Hypothesis, ...]


ALL_HYPOTHESES = HypothesisSet(
    plastisol=tuple(singles()), pairs=pairs, gelatin=tuple(map(of_gelatin, OF_GELATIN))
)
