"""The study of one material: its figures, the fits to them, and the verdict."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from models.materials import tissue_stiffness_n_mm_per_rad_per_mm, tissue_time_constant_s
from studies.published.experiments.measurement import MeasuredFigure
from studies.published.experiments.replay import FigureReplay
from studies.published.experiments.rig import PublishedRig
from studies.published.fitting.fit import FigureFit
from studies.published.selection.attainability import Unattainable
from studies.published.selection.verdict import FigureVerdict


@dataclass(frozen=True, kw_only=True)
class TextComparison:
    """A figure that the text gives in words, beside the predictions of the stated rig and of every fit.

    Attributes:
      stated: prediction of the first stated rig, in the figure's unit.
      yielding: prediction of the same rig in tissue with the spring and damper of Section IV-A2.
      predicted: prediction of each leading fit, in the verdict's order.
      by_fit: prediction of every fit, in the order of the study's fits.
    """

    figure: MeasuredFigure
    stated: float
    yielding: float
    predicted: tuple[float, ...]
    by_fit: tuple[float, ...]

    def residual(self, value: float) -> float:
        """A predicted value minus the published one, in standard deviations."""
        return (value - self.figure.value) / self.figure.sigma


@dataclass(frozen=True, kw_only=True)
class MaterialStudy:
    """One material: its figures, the stated rig, all fits, and the verdict.

    Attributes:
      stated: the stated rig, with each free length.
      fits: single mechanisms, then pairs, each in the order of AICc.
      unattainable: by hypothesis, figures that its single mechanism cannot explain.
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
    figures: Sequence[MeasuredFigure],
    stated: FigureFit,
    fits: Sequence[FigureFit],
    verdict: FigureVerdict,
    replay: FigureReplay,
) -> tuple[TextComparison, ...]:
    """Figures of the text beside the stated rig, also in yielding tissue, and beside the fits."""
    rig = stated.hypothesis.base
    shown = [f.hypothesis.rig(f.x) for f in (*verdict.leading, *fits)]
    predicted = replay(figures, [rig, _yielding(rig), *shown])
    count = 2 + len(verdict.leading)
    return tuple(
        TextComparison(
            figure=figure,
            stated=float(row[0]),
            yielding=float(row[1]),
            predicted=tuple(map(float, row[2:count])),
            by_fit=tuple(map(float, row[count:])),
        )
        for figure, row in zip(figures, predicted, strict=True)
    )


def _yielding(rig: PublishedRig) -> PublishedRig:
    """The rig in tissue with the elasticity and creep that Section IV-A2 states."""
    model = replace(
        rig.model,
        tissue_stiffness_n_mm_per_rad_per_mm=tissue_stiffness_n_mm_per_rad_per_mm(),
        tissue_time_constant_s=tissue_time_constant_s(),
    )
    return replace(rig, model=model)
