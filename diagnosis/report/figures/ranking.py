"""The probabilities of the explanations: a set of effects is one bar."""

from matplotlib.figure import Figure

from diagnosis.report.figures.layout import subplots
from diagnosis.report.figures.style import PREDICTIONS
from diagnosis.report.sentences.names import explanations
from diagnosis.result import Diagnosis

_SHOWN = 6


def draw_ranking(found: Diagnosis) -> Figure:
    """The first of the explanations."""
    best = explanations(found)[:_SHOWN]
    figure, axis = subplots(figsize=(8, 0.9 + 0.3 * len(best)))
    bars = axis.barh(range(len(best)), [p for _, p in best], color=PREDICTIONS["explained"])
    axis.bar_label(bars, [f" {p:.3f}" for _, p in best], fontsize=9)
    axis.set_yticks(range(len(best)), [name for name, _ in best], fontsize=9)
    axis.invert_yaxis()
    axis.set(xlim=(0, 1.1), xlabel="probability")
    return figure


def describe_ranking(found: Diagnosis) -> str:
    """The picture in words."""
    told = ", ".join(f"{name} {p:.3f}" for name, p in explanations(found)[:_SHOWN])
    return f"Bars of the probability of each explanation: {told}."
