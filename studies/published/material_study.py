"""One material: its figures, what was fitted to them, and what that allows to be concluded."""

from collections.abc import Sequence
from dataclasses import dataclass

from studies.published.experiments.measurement import MeasuredFigure
from studies.published.experiments.replay import FigureReplay
from studies.published.fitting.fit import FigureFit
from studies.published.selection.attainability import Unattainable
from studies.published.selection.verdict import FigureVerdict


@dataclass(frozen=True, kw_only=True)
class TextComparison:
    """A figure that the text gives in words, beside what the stated rig and the leading fits predict.

    Attributes:
      stated: by the first stated rig, in the figure's unit.
      predicted: by each leading fit, in the verdict's order.
    """

    figure: MeasuredFigure
    stated: float
    predicted: tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class MaterialStudy:
    """One material: its figures, the stated rig, all fits, and the verdict.

    Attributes:
      stated: the stated rig, with each free length.
      fits: single mechanisms, then pairs, each in the order of AICc.
      unattainable: figures that a single mechanism cannot explain, by hypothesis.
      text: figures that the text gives in words.
    """

    material: str
    figures: tuple[MeasuredFigure, ...]
    stated: tuple[FigureFit, ...]
    fits: tuple[FigureFit, ...]
    unattainable: Unattainable
    verdict: FigureVerdict
    text: tuple[TextComparison, ...]

    def stated_as(self, fit: FigureFit) -> FigureFit:
        """The stated rig with the free length of a fit."""
        return next(s for s in self.stated if s.hypothesis.base == fit.hypothesis.base)

    def singles(self) -> list[FigureFit]:
        """Fits of single mechanisms, in the order of AICc."""
        return [f for f in self.fits if len(f.hypothesis.names) == 1]

    def pairs(self) -> list[FigureFit]:
        """Fits of pairs, in the order of AICc."""
        return [f for f in self.fits if len(f.hypothesis.names) > 1]


def compare_with_text(
    figures: Sequence[MeasuredFigure], stated: FigureFit, verdict: FigureVerdict, replay: FigureReplay
) -> tuple[TextComparison, ...]:
    """Figures of the text beside the stated rig and the leading fits."""
    fits = (stated, *verdict.leading)
    predicted = replay(figures, [f.hypothesis.rig(f.x) for f in fits])
    return tuple(
        TextComparison(figure=figure, stated=float(row[0]), predicted=tuple(map(float, row[1:])))
        for figure, row in zip(figures, predicted, strict=True)
    )
