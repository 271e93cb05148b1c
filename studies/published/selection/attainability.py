"""What a candidate could make of a figure at any strength.

It is fitted to Table II and to that one figure alone, within its bounds. A figure that
is still missed by more than two spreads cannot be closed by this candidate, however
strong and whatever it does to the others, as long as Table II stands. The search is
local: of candidates with several parameters it could miss a far corner.
"""

from studies.published.experiments.figures import Figure, Measure
from studies.published.experiments.replay import Replay
from studies.published.fitting.fit import Fit, Fitter
from studies.published.selection.verdict import CLOSED, still_open

_ITERATIONS = 4


def out_of_reach(fit: Fit, replay: Replay) -> tuple[Figure, ...]:
    """Figures of a quick turn that no strength of a fitted candidate closes."""
    table_ii = tuple(f for f in fit.figures if f.measure is Measure.DAMPING)
    doubtful = [f for f in still_open(fit) if f not in table_ii]
    return tuple(f for f in doubtful if not _closes(fit, (*table_ii, f), replay))


def _closes(fit: Fit, figures: tuple[Figure, ...], replay: Replay) -> bool:
    """Whether a fit to these figures alone meets the last of them."""
    fitter, hypothesis = Fitter(figures, replay), fit.hypothesis
    x = fitter.nearest(hypothesis, [fit.x], iterations=_ITERATIONS)
    return bool(abs(fitter.missed(hypothesis, x[:, None])[-1, 0]) <= CLOSED)
