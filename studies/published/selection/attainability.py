"""Which figures a mechanism cannot explain with any parameter values.

The mechanism is fitted to Table II and to one figure only, within its bounds. If the figure is
then still more than two standard deviations off, it is unattainable for this mechanism, whatever
happens to the other figures, as long as Table II is right. The search is local: with several
parameters it could miss a distant solution.
"""

from studies.published.criteria import ATTAINABLE_ITERATIONS, RESOLVED_SIGMA
from studies.published.experiments.measurement import MeasuredFigure, Quantity
from studies.published.experiments.replay import FigureReplay
from studies.published.fitting.fit import FigureFit
from studies.published.fitting.fitter import FigureFitter
from studies.published.fitting.hypothesis import Hypothesis
from studies.published.selection.verdict import unresolved

Unattainable = dict[Hypothesis, tuple[MeasuredFigure, ...]]


def unattainable(
    fit: FigureFit, replay: FigureReplay, known: Unattainable | None = None
) -> tuple[MeasuredFigure, ...]:
    """Figures of the quick turn that the mechanism of a fit cannot explain.

    Args:
      known: results for other hypotheses: a figure that a special case of this mechanism explains is
        explained by it, too.
    """
    table_ii = tuple(f for f in fit.figures if f.quantity is Quantity.DAMPING)
    doubtful = [f for f in unresolved(fit) if f not in table_ii]
    found = tuple(f for f in doubtful if not _attains(fit, (*table_ii, f), replay))
    special_cases = _special_cases(fit.hypothesis, known or {})
    return tuple(f for f in found if all(f in figures for figures in special_cases))


def _attains(fit: FigureFit, figures: tuple[MeasuredFigure, ...], replay: FigureReplay) -> bool:
    """Whether a fit to these figures alone explains the last of them."""
    fitter, hypothesis = FigureFitter(figures, replay), fit.hypothesis
    x = fitter.minimum(hypothesis, [fit.x], iterations=ATTAINABLE_ITERATIONS)
    return bool(abs(fitter.residual(hypothesis, x[:, None])[-1, 0]) <= RESOLVED_SIGMA)


def _special_cases(hypothesis: Hypothesis, known: Unattainable) -> list[tuple[MeasuredFigure, ...]]:
    """Unattainable figures of the special cases of a hypothesis, as far as they are known."""
    return [
        known[h]
        for name in hypothesis.mechanisms[-1].contains
        for h in known
        if h.names == (name,) and h.base == hypothesis.base
    ]
