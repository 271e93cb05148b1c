"""Figs. 11 and 12 under every hypothesis: a table, and its results in sentences."""

import math

from models import published
from studies.published.experiments.text_figures import TEXT_FIGURES_PLASTISOL
from studies.published.fitting.insertion_hypotheses import (
    SLOW_TURN_SHAFT_MM,
    prebend_drag_n_mm_s,
    prebend_torque_n_mm,
)
from studies.published.insertion_study import InsertionPrediction, InsertionStudy
from studies.published.report.tables import TextTable
from studies.published.report.values import deviation_text, value_text

_ALONE_MM, _COMPENSATED_MM = published.FIG_12_BASE_ONLY.value, published.FIG_12_COMPENSATED.value


def insertion_table(study: InsertionStudy) -> TextTable:
    """Both deviations and the text's figures of plastisol by hypothesis, nearest to Fig. 12 first."""
    return TextTable(
        head=(
            "hypothesis",
            "value",
            f"base alone ({_ALONE_MM:g} mm)",
            f"compensated ({_COMPENSATED_MM:g} mm)",
            "rms residual / σ",
            *(f"{f.source} {f.quantity.value} ({f.value:g} {f.unit})" for f in TEXT_FIGURES_PLASTISOL),
        ),
        rows=tuple(
            (
                p.hypothesis.name + (" *" if p.meets_both else ""),
                value_or_basis(p),
                f"{p.alone_mm:.1f}",
                f"{p.compensated_mm:.1f}",
                f"{p.rms_residual:.1f}",
                *(value_text(f, v) for f, v in zip(TEXT_FIGURES_PLASTISOL, p.text, strict=True)),
            )
            for p in study.predictions
        ),
    )


def value_or_basis(prediction: InsertionPrediction) -> str:
    """The value that was fitted to Fig. 12, or the origin of any other value."""
    parameter, basis = prediction.hypothesis.parameter, prediction.hypothesis.basis
    if parameter is None:
        return basis
    value = f"{prediction.value:.3g} {parameter.unit} (set by {_ALONE_MM:g} mm)".replace(" - ", " ")
    if math.isnan(prediction.value):
        value = f"none of {parameter.low:.3g} to {parameter.high:.3g} gives {_ALONE_MM:g} mm"
    return f"{value}; {basis}" if basis else value


def insertion_sentences(study: InsertionStudy) -> list[str]:
    """Results for Figs. 11 and 12; one or two sentences per point."""
    return [
        _stated(study),
        _one_way(study),
        *_explanations(study),
        *_of_tables(study),
        *_with_channel(study),
        _prebend(),
    ]


def _stated(study: InsertionStudy) -> str:
    stated = study.stated
    turning = next((p for p in study.predictions if p.hypothesis.name == "no friction at all"), None)
    own = (
        f" Without any friction, {deviation_text(turning.alone_mm)} and "
        f"{deviation_text(turning.compensated_mm)} remain, because the turn of the base "
        "itself takes time."
        if turning
        else ""
    )
    return (
        f"Fig. 12 has {_ALONE_MM:g} mm with the base alone and {_COMPENSATED_MM:g} mm compensated; the "
        f"stated model gives {deviation_text(stated.alone_mm)} and "
        f"{deviation_text(stated.compensated_mm)}.{own}"
    )


def _one_way(study: InsertionStudy) -> str:
    alone, compensated = study.one_way_mm
    return (
        "The half turns go to and fro on the same side, as the text says. If all went one way, "
        f"the deviation of the stated model would be {alone:.2f} mm and {compensated:.2f} mm."
    )


def _explanations(study: InsertionStudy) -> list[str]:
    both = [p for p in study.predictions if p.meets_both]
    if not both:
        return ["No hypothesis meets both deviations within 2 σ."]
    said = [
        f"Both deviations within 2 σ: {'; '.join(map(_named, both))}. Two figures cannot test more "
        "than this."
    ]
    worse = [p.hypothesis.name for p in both if study.worsened(p)]
    if worse:
        said.append(
            f"If the tissue was the plastisol of Figs. 3 and 5, {', '.join(worse)} would miss those by "
            "far more than the stated model does."
        )
    left = [_named(p) for p in both if not study.worsened(p)]
    if left:
        said.append(f"Without such a contradiction: {'; '.join(left)}.")
    return said


def _of_tables(study: InsertionStudy) -> list[str]:
    """Sentences on Fig. 12 under the explanations of the tables."""
    found = [p for p in study.predictions if p.hypothesis.of_tables and not p.hypothesis.parameter]
    if not found:
        return []
    alone, compensated = ([p.alone_mm for p in found], [p.compensated_mm for p in found])
    return [
        f"The explanations of Tables II, IV and V predict {_range(alone)} with the base alone and "
        f"{_range(compensated)} compensated, also with {SLOW_TURN_SHAFT_MM:g} mm of shaft: they do "
        "not explain Fig. 12 as well."
        if not any(p.meets_both for p in found)
        else "Of the explanations of Tables II, IV and V, "
        + "; ".join(_named(p) for p in found if p.meets_both)
        + " explains Fig. 12 as well."
    ]


def _with_channel(study: InsertionStudy) -> list[str]:
    """Sentences on the best explanation of the tables, with a prebent tip in its channel."""
    return [
        f"With {_named(p)}, {deviation_text(p.compensated_mm)} remain if compensated. Gain and motor of "
        "the compensator are ours, not the paper's."
        for p in study.predictions
        if p.hypothesis.of_tables and math.isfinite(p.value)
    ]


def _range(values_mm: list[float]) -> str:
    return f"{min(values_mm):.1f} to {max(values_mm):.1f} mm"


def _named(prediction: InsertionPrediction) -> str:
    return f"{prediction.hypothesis.name}, {value_or_basis(prediction)}"


def _prebend() -> str:
    return (
        f"A prebent tip would need up to {prebend_torque_n_mm():.1f} N mm for a quarter turn in a rigid "
        f"channel, and would have a drag of {prebend_drag_n_mm_s():.0f} N mm s / rad as a slender body; "
        "that drag is far more than Fig. 12 allows."
    )
