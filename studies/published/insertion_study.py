"""Figs. 11 and 12: predictions of each hypothesis for both insertions, and for Figs. 3 and 5.

The parameter of a hypothesis gets the value at which the base alone deviates by the published
12 mm; the deviation with compensation is then a prediction, to compare with 4 mm. Two figures
allow no further test. A hypothesis that changes the shaft or the tissue also predicts
the lag in Fig. 3 and the settling in Fig. 5, if the tissue was the same plastisol.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from diagnosis.effects.effect import Parameter
from models import published
from studies.published.criteria import COARSE_SCAN, INSERTION_SIGMA, RESOLVED_SIGMA
from studies.published.experiments.insertion import (
    InsertionRig,
    WindingSense,
    deviation_compensated_mm,
    deviations_alone_mm,
)
from studies.published.experiments.replay import FigureReplay
from studies.published.experiments.rig import PublishedRig
from studies.published.experiments.text_figures import TEXT_FIGURES_PLASTISOL
from studies.published.fitting.fit import FigureFit
from studies.published.fitting.insertion_hypotheses import (
    ALL_INSERTION_HYPOTHESES,
    SLOW_TURN_SHAFT_MM,
    STATED_INSERTION,
    InsertionHypothesis,
    prebend_torque_n_mm,
)

_ALONE_MM, _COMPENSATED_MM = published.FIG_12_BASE_ONLY, published.FIG_12_COMPENSATED
_ROUNDING_MM = 1.0 / math.sqrt(12)


@dataclass(frozen=True, kw_only=True)
class InsertionPrediction:
    """Predictions of a hypothesis for Figs. 11 and 12, and for the text's figures of plastisol.

    Attributes:
      value: value of its parameter; NaN if it has none, or if no value gives 12 mm.
      alone_mm, compensated_mm: deviations; the first is fitted if there is a parameter.
      text: predictions of `TEXT_FIGURES_PLASTISOL`, in their units.
    """

    hypothesis: InsertionHypothesis
    value: float
    alone_mm: float
    compensated_mm: float
    text: tuple[float, ...]

    @property
    def residual(self) -> tuple[float, float]:
        """(Predicted - published) / sigma of both deviations."""
        return (
            (self.alone_mm - _ALONE_MM.value) / sigma_mm(_ALONE_MM.value),
            (self.compensated_mm - _COMPENSATED_MM.value) / sigma_mm(_COMPENSATED_MM.value),
        )

    @property
    def rms_residual(self) -> float:
        """Root mean square of both residuals."""
        return math.hypot(*self.residual) / math.sqrt(2)

    @property
    def meets_both(self) -> bool:
        """Whether both deviations are within two standard deviations."""
        return max(map(abs, self.residual)) <= RESOLVED_SIGMA

    def text_misses(self) -> tuple[float, ...]:
        """Distance from every figure of the text, in standard deviations."""
        return tuple(
            abs(value - figure.value) / figure.sigma
            for figure, value in zip(TEXT_FIGURES_PLASTISOL, self.text, strict=True)
        )


@dataclass(frozen=True, kw_only=True)
class InsertionStudy:
    """Figs. 11 and 12 under every hypothesis.

    Attributes:
      predictions: the best for both deviations first.
      one_way_mm: deviations of the stated rig, base alone and compensated, if all half turns have
        the same sense.
    """

    predictions: tuple[InsertionPrediction, ...]
    one_way_mm: tuple[float, float]

    @property
    def stated(self) -> InsertionPrediction:
        """The rig as stated."""
        return next(p for p in self.predictions if p.hypothesis is STATED_INSERTION)

    def worsened(self, prediction: InsertionPrediction) -> tuple[str, ...]:
        """Figures of the text that it misses by two more standard deviations than the stated rig."""
        misses = zip(
            TEXT_FIGURES_PLASTISOL, prediction.text_misses(), self.stated.text_misses(), strict=True
        )
        return tuple(f.name for f, now, stated in misses if now > stated + RESOLVED_SIGMA)


def sigma_mm(deviation_mm: float) -> float:
    """Standard deviation of a deviation that is printed to 1 mm."""
    return math.hypot(INSERTION_SIGMA * deviation_mm, _ROUNDING_MM)


def study_insertions(
    replay: FigureReplay,
    fits: Sequence[FigureFit] = (),
    *,
    hypotheses: Sequence[InsertionHypothesis] = ALL_INSERTION_HYPOTHESES,
) -> InsertionStudy:
    """Predict both insertions with every hypothesis, and with fits to the tables.

    Args:
      fits: fits to Tables II, IV and V, best first. Each becomes a hypothesis without a parameter, with
        the shaft of this study and with that of the slow turns; the best one also with a prebent tip.

    Raises:
      SimulationFailed: a rig cannot be simulated.
    """
    lengths = (InsertionRig().shaft_mm, SLOW_TURN_SHAFT_MM)
    of_tables = [of_fit(fit, length) for length in lengths for fit in fits]
    wanted = (*hypotheses, *of_tables, *map(in_channel, of_tables[len(fits) : len(fits) + 1]))
    predictions = sorted((predict(h, replay) for h in wanted), key=lambda p: p.rms_residual)
    rig, sense = InsertionRig(), WindingSense.ONE_WAY
    one_way = (deviations_alone_mm([rig], sense)[0], deviation_compensated_mm(rig, sense))
    return InsertionStudy(predictions=tuple(predictions), one_way_mm=one_way)


def of_fit(fit: FigureFit, shaft_mm: float) -> InsertionHypothesis:
    """A fit to the tables as a hypothesis on the insertion: the same tissue, drive and motion."""
    found = fit.hypothesis.rig(fit.x)
    rig = InsertionRig(model=found.model.without_sensors, turn=found.turn, shaft_mm=shaft_mm)
    return InsertionHypothesis(
        name=" and ".join(fit.hypothesis.names),
        basis=f"Tables II, IV, V, {fit.hypothesis.free_length}; {shaft_mm:g} mm of shaft",
        of_tables=True,
        apply=lambda _: rig,
    )


def in_channel(hypothesis: InsertionHypothesis) -> InsertionHypothesis:
    """A hypothesis without a parameter, plus a prebent tip in a channel that is fitted to Fig. 12."""
    most = prebend_torque_n_mm()
    return InsertionHypothesis(
        name=f"{hypothesis.name}, prebent tip in the channel that it cuts",
        basis=hypothesis.basis,
        parameter=Parameter(
            name="value", unit="N mm", low=0.03 * most, high=most, start=(most,), logarithmic=True
        ),
        of_tables=True,
        scan=COARSE_SCAN,
        apply=lambda torque: replace(hypothesis.apply(math.nan), channel_n_mm=torque),
    )


def predict(hypothesis: InsertionHypothesis, replay: FigureReplay) -> InsertionPrediction:
    """Both deviations, and the text's figures of plastisol, under one hypothesis."""
    value = value_for_base_alone(hypothesis)
    rig = hypothesis.apply(value if math.isfinite(value) else _nearest_end(hypothesis))
    text = replay(TEXT_FIGURES_PLASTISOL, [_through_tissue(rig)])[:, 0]
    return InsertionPrediction(
        hypothesis=hypothesis,
        value=value,
        alone_mm=deviations_alone_mm([rig])[0],
        compensated_mm=deviation_compensated_mm(rig),
        text=tuple(map(float, text)),
    )


def _through_tissue(rig: InsertionRig) -> PublishedRig:
    """The rig of Figs. 3 and 5: its tip is outside the tissue, its lengths are stated."""
    outside = replace(rig.model, tip_drag_n_mm_s_per_rad=0.0, curvature_n_mm_per_mm=0.0)
    return PublishedRig(model=outside, turn=rig.turn)


def value_for_base_alone(hypothesis: InsertionHypothesis) -> float:
    """The value of the parameter, nearest to neutral, at which the base alone deviates by 12 mm.

    NaN if there is no parameter, or no such value within its bounds.
    """
    p = hypothesis.parameter
    if p is None:
        return math.nan
    scanned = np.geomspace(p.low, p.high, hypothesis.scan)
    for _ in range(2):  # the second scan between neighbours of the first
        miss = np.array(deviations_alone_mm([hypothesis.apply(float(v)) for v in scanned]))
        miss -= _ALONE_MM.value
        crossings = np.flatnonzero(np.diff(np.sign(miss)) != 0)
        if crossings.size == 0:
            return math.nan
        # A rate falls from the stated one, everything else rises from it.
        i = int(crossings[0] if miss[0] < 0 else crossings[-1])
        low, high = scanned[i], scanned[i + 1]
        share = miss[i] / (miss[i] - miss[i + 1])
        scanned = np.geomspace(low, high, hypothesis.scan)
    return float(low * (high / low) ** share)


def _nearest_end(hypothesis: InsertionHypothesis) -> float:
    """The end of the parameter's range whose deviation is nearer to 12 mm; NaN without a parameter."""
    p = hypothesis.parameter
    if p is None:
        return math.nan
    ends = (p.low, p.high)
    found = deviations_alone_mm([hypothesis.apply(end) for end in ends])
    return min(zip(found, ends, strict=True), key=lambda f: abs(f[0] - _ALONE_MM.value))[1]
