"""What each further effect would add to an explanation, on the thinned log."""

from collections.abc import Sequence

import numpy as np

from diagnosis.coordinates import coordinates_of
from diagnosis.evidence import Evidence
from diagnosis.fit import Fit, fit_effects
from diagnosis.glance import glance
from diagnosis.team import Team

_ITERATIONS = 3
_STARTS = 2


def on_thinned(coarse: Evidence, best: Fit) -> Fit:
    """The best fit, once more on the thinned log."""
    start = coordinates_of(best.names, coarse.nuisance).joined(best.parts)
    return fit_effects(coarse, best.names, start, most_iterations=_ITERATIONS)


def further(
    coarse: Evidence, best: Fit, base: Fit, effects: Sequence[str], team: Team
) -> dict[str, float]:
    """Gap that the best fit may come down to with one more effect, least first.

    Args:
      base: the best fit on the thinned log.
    """
    calls = [(coarse, base, name, _STARTS) for name in effects if name not in base.names]
    hints = [found[0] for found in team.each("looking further", glance, calls)]
    samples = max(base.samples, 1)
    # The floor of the thinned log is not exactly that of the log: ratios carry over.
    scale = best.gap / np.sqrt(base.cost / samples) if base.cost > 0 else 1.0
    left = {h.names[-1]: float(scale * np.sqrt(h.cost / samples)) for h in hints}
    return dict(sorted(left.items(), key=lambda item: item[1]))
