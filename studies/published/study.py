"""`needle diagnose --paper`: all simulations and fits, stage by stage."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from studies.published.compensator import CompensatorFigure, compensator_figures
from studies.published.experiments.replay import FigureReplay
from studies.published.fitting.fit import FigureFit
from studies.published.fitting.insertion_hypotheses import (
    ALL_INSERTION_HYPOTHESES,
    InsertionHypothesis,
)
from studies.published.gelatin_study import study_gelatin
from studies.published.insertion_study import InsertionStudy, study_insertions
from studies.published.material_study import MaterialStudy
from studies.published.plastisol_study import Progress, study_plastisol
from studies.published.selection.discrimination import ProposedExperiment, proposed_experiments
from studies.published.selection.hypothesis_set import ALL_HYPOTHESES, HypothesisSet

_PLASTISOL_BEGINS, _PLASTISOL_ENDS, _INSERTIONS_BEGIN = 0.05, 0.65, 0.7  # shares of the time


@dataclass(frozen=True, kw_only=True)
class PublishedStudy:
    """All results of the study.

    Attributes:
      insertions: Figs. 11 and 12 under their own hypotheses.
      compensator: figures of the compensator, which test nothing, beside ours.
      proposed: experiments with plastisol, in the order of how many hypotheses they separate.
      warnings: of fits whose simulation did not converge.
    """

    plastisol: MaterialStudy
    gelatin: MaterialStudy
    insertions: InsertionStudy
    compensator: tuple[CompensatorFigure, ...]
    proposed: tuple[ProposedExperiment, ...]
    warnings: tuple[str, ...]


def run_published_study(
    progress: Progress = lambda what, share: None,
    *,
    hypotheses: HypothesisSet = ALL_HYPOTHESES,
    insertions: Sequence[InsertionHypothesis] = ALL_INSERTION_HYPOTHESES,
    compensator: Callable[[], tuple[CompensatorFigure, ...]] = compensator_figures,
) -> PublishedStudy:
    """Run everything; about a minute and a half on one core.

    Args:
      progress: called with the stage that begins, and the share that is done.
      hypotheses: hypotheses to fit.
      insertions: hypotheses on the steered insertions.
      compensator: computes the figures of the compensator.

    Raises:
      SimulationFailed: a rig cannot be simulated.
    """
    replay = FigureReplay()
    progress("gelatin", 0.0)
    gelatin = study_gelatin(hypotheses, replay)
    plastisol = study_plastisol(
        hypotheses,
        replay,
        lambda what, share: progress(
            what, _PLASTISOL_BEGINS + (_PLASTISOL_ENDS - _PLASTISOL_BEGINS) * share
        ),
    )
    progress("the compensator's columns", _PLASTISOL_ENDS)
    turns = compensator()
    progress("steered insertions", _INSERTIONS_BEGIN)
    return PublishedStudy(
        plastisol=plastisol,
        gelatin=gelatin,
        insertions=study_insertions(replay, plastisol.verdict.accepted, hypotheses=insertions),
        compensator=turns,
        proposed=tuple(proposed_experiments(plastisol.verdict.accepted, replay)),
        warnings=_not_converged((*gelatin.fits, *plastisol.fits), replay),
    )


def _not_converged(fits: Sequence[FigureFit], replay: FigureReplay) -> tuple[str, ...]:
    stages = [(f.hypothesis, replay.unconverged(f.hypothesis.rig(f.x))) for f in fits]
    return tuple(
        f"{' and '.join(hypothesis.names)}: {count} stages of the simulation did not converge"
        for hypothesis, count in stages
        if count
    )
