"""The study of gelatin: four held torques, single effects."""

from studies.published.experiments.figures import gelatin
from studies.published.experiments.replay import FigureReplay
from studies.published.experiments.rig import WITH_FREE_LENGTH
from studies.published.experiments.text_figures import TEXT_FIGURES_GELATIN
from studies.published.fitting.fitter import FigureFitter
from studies.published.fitting.hypothesis import stated
from studies.published.material_study import MaterialStudy, compare_with_text
from studies.published.selection.hypothesis_set import HypothesisSet
from studies.published.selection.verdict import by_aicc, figure_verdict


def study_gelatin(hypotheses: HypothesisSet, replay: FigureReplay) -> MaterialStudy:
    """Fit single effects to the torques that gelatin holds.

    Raises:
      SimulationFailed: a rig cannot be simulated.
    """
    fitter = FigureFitter(gelatin(), replay)
    as_stated = (fitter.fit(stated(WITH_FREE_LENGTH)),)
    fits = sorted(map(fitter.fit, hypotheses.gelatin), key=by_aicc)
    verdict = figure_verdict(as_stated, fits)
    return MaterialStudy(
        material="gelatin",
        figures=fitter.figures,
        stated=as_stated,
        fits=tuple(fits),
        unattainable={},
        verdict=verdict,
        text=compare_with_text(TEXT_FIGURES_GELATIN, as_stated[0], fits, verdict, replay),
    )
