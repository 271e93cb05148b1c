"""The study of plastisol: eight figures, single mechanisms and pairs, two free lengths."""

from collections.abc import Callable, Sequence

from studies.published.experiments.figures import plastisol
from studies.published.experiments.replay import FigureReplay
from studies.published.experiments.rig import STATED_RIGS, PublishedRig
from studies.published.experiments.text_figures import TEXT_FIGURES_PLASTISOL
from studies.published.fitting.fit import FigureFit
from studies.published.fitting.fitter import FigureFitter
from studies.published.fitting.hypothesis import Hypothesis, stated
from studies.published.material_study import MaterialStudy, compare_with_text
from studies.published.selection.attainability import Unattainable, unattainable
from studies.published.selection.hypothesis_set import HypothesisSet
from studies.published.selection.starting_points import starts_of_pair, starts_of_single
from studies.published.selection.verdict import by_aicc, figure_verdict

Progress = Callable[[str, float], None]


def study_plastisol(
    hypotheses: HypothesisSet, replay: FigureReplay, progress: Progress
) -> MaterialStudy:
    """Fit single mechanisms, then pairs, to Tables II, IV and V.

    Args:
      progress: called with the stage that begins, and the share of this study that is done.

    Raises:
      SimulationFailed: a rig cannot be simulated.
    """
    fitter = FigureFitter(plastisol(), replay)
    as_stated = tuple(fitter.fit(stated(base)) for base in STATED_RIGS)
    alone = _fit_singles(fitter, hypotheses.plastisol, lambda what, share: progress(what, 0.5 * share))
    limits: Unattainable = {}
    for fit in alone:
        limits[fit.hypothesis] = unattainable(fit, replay, limits)
    wanted = hypotheses.pairs(alone)
    both = _fit_pairs(fitter, wanted, alone, lambda what, share: progress(what, 0.5 + 0.5 * share))
    fits = (*sorted(alone, key=by_aicc), *sorted(both, key=by_aicc))
    verdict = figure_verdict(as_stated, fits)
    return MaterialStudy(
        material="plastisol",
        figures=fitter.figures,
        stated=as_stated,
        fits=fits,
        unattainable=limits,
        verdict=verdict,
        text=compare_with_text(TEXT_FIGURES_PLASTISOL, as_stated[0], fits, verdict, replay),
    )


def _fit_singles(
    fitter: FigureFitter, singles: Sequence[Hypothesis], progress: Progress
) -> list[FigureFit]:
    """Fits of single mechanisms; for each stated rig, that of the damping comes first."""
    fits: list[FigureFit] = []
    damping: dict[PublishedRig, FigureFit] = {}
    for i, single in enumerate(singles):
        progress(f"{single.names[0]}, {single.free_length}", i / len(singles))
        fits.append(fitter.fit(single, starts_of_single(single, damping.get(single.base))))
        damping.setdefault(single.base, fits[-1])
    return fits


def _fit_pairs(
    fitter: FigureFitter, pairs: Sequence[Hypothesis], alone: Sequence[FigureFit], progress: Progress
) -> list[FigureFit]:
    known = {(f.hypothesis.base, f.hypothesis.names[0]): f for f in alone}
    fits = []
    for i, pair in enumerate(pairs):
        progress(" and ".join(pair.names), i / len(pairs))
        singles = {n: known[pair.base, n] for n in pair.names if (pair.base, n) in known}
        fits.append(fitter.fit(pair, starts_of_pair(pair, singles)))
    return fits
