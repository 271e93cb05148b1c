"""The results as tables of text."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from studies.published.experiments.measurement import MeasuredFigure
from studies.published.fitting.fit import FigureFit, rms
from studies.published.material_study import MaterialStudy
from studies.published.report.values import fitted_values, names_in_words, percent, value_text
from studies.published.selection.twist_constraint import contradiction
from studies.published.selection.verdict import unresolved
from studies.published.study import PublishedStudy

_MOST_PAIRS = 12
_MOST_RANKED = 10


@dataclass(frozen=True, kw_only=True)
class TextTable:
    """A table of text: names of the columns, and rows of as many cells."""

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def figure_table(study: MaterialStudy) -> TextTable:
    """Published, simulated, ratio and residual of every figure, with each free length."""
    head = ["figure", "published", "sigma"]
    for fit in study.stated:
        head += [f"simulated{_free_length(fit, study, before=', ')}", "ratio", "residual / σ"]
    return TextTable(
        head=tuple(head),
        rows=tuple(_figure_row(i, figure, study) for i, figure in enumerate(study.figures)),
    )


def _figure_row(i: int, figure: MeasuredFigure, study: MaterialStudy) -> tuple[str, ...]:
    row = [figure.name, f"{figure.value:g} {figure.unit}", f"{figure.sigma:.2g}"]
    for fit in study.stated:
        simulated = float(fit.predicted[i])
        row += [
            value_text(figure, simulated),
            f"{simulated / figure.value:.2f}",
            f"{fit.residual[i]:+.1f}",
        ]
    return tuple(row)


def _free_length(fit: FigureFit, study: MaterialStudy, *, before: str = "") -> str:
    """The free length of a fit, where there is more than one."""
    return before + fit.hypothesis.free_length if len(study.stated) > 1 else ""


def mechanism_table(study: MaterialStudy, *, with_values: bool = True) -> TextTable:
    """Every single mechanism and the best pairs, in the order of AICc; a star marks accepted ones.

    Args:
      with_values: whether the fitted values have a column.
    """
    columns = (
        "mechanism",
        "free length",
        "values (95 %)",
        "rms residual / σ",
        "left out",
        "p",
        "AICc",
        "unresolved",
        "unattainable",
    )
    kept = [name != "values (95 %)" or with_values for name in columns]
    rows = (_mechanism_row(fit, study) for fit in (*study.singles(), *study.pairs()[:_MOST_PAIRS]))
    return TextTable(head=_kept(columns, kept), rows=tuple(_kept(row, kept) for row in rows))


def _kept(cells: Sequence[str], kept: Sequence[bool]) -> tuple[str, ...]:
    return tuple(cell for cell, keep in zip(cells, kept, strict=True) if keep)


def _mechanism_row(fit: FigureFit, study: MaterialStudy) -> tuple[str, ...]:
    return (
        _starred(fit, study),
        _free_length(fit, study),
        _values(fit),
        f"{study.stated_as(fit).rms_residual:.1f} → {fit.rms_residual:.2f}",
        f"{fit.rms_left_out:.2f}",
        f"{fit.p_value:.2g}",
        f"{fit.aicc:.1f}",
        _short(unresolved(fit)),
        contradiction(fit) or _short(study.unattainable.get(fit.hypothesis, ())),
    )


def _starred(fit: FigureFit, study: MaterialStudy) -> str:
    return names_in_words(fit.hypothesis.names) + (" *" if fit in study.verdict.accepted else "")


def _values(fit: FigureFit) -> str:
    values = [
        f"{mechanism} {name} {p['value']:.3g} ({p['low']:.3g} to {p['high']:.3g}) {p['unit']}"
        for mechanism, of in fitted_values(fit).items()
        for name, p in of.items()
    ]
    return "; ".join(value.removesuffix(" -") for value in values)


def _short(figures: Sequence[MeasuredFigure]) -> str:
    """Short names of figures: table and depth."""
    return ", ".join(f"{f.source.removeprefix('Table ')} {f.depth_mm / 10:g} cm" for f in figures)


def accepted_table(study: MaterialStudy) -> TextTable:
    """Fitted values of the accepted explanations."""
    return TextTable(
        head=("explanation", "free length", "values (95 %)"),
        rows=tuple(
            (names_in_words(f.hypothesis.names), _free_length(f, study), _values(f))
            for f in study.verdict.accepted
            if f.hypothesis.names
        ),
    )


def text_table(study: MaterialStudy) -> TextTable:
    """Figures of the text beside predictions of the stated rig and of the leading explanations."""
    fits = study.verdict.leading
    names = [names_in_words(f.hypothesis.names) + _free_length(f, study, before=", ") for f in fits]
    return TextTable(
        head=("figure", "in the text", "stated", "stated, tissue yields", *names),
        rows=tuple(
            (
                comparison.figure.name,
                f"about {comparison.figure.value:g} {comparison.figure.unit}",
                *(
                    value_text(comparison.figure, v)
                    for v in (comparison.stated, comparison.yielding, *comparison.predicted)
                ),
            )
            for comparison in study.text
        ),
    )


def text_ranking_table(study: MaterialStudy) -> TextTable:
    """The mechanisms whose fits to the tables agree best with the text's figures, best first."""
    misses = [
        rms(np.array([c.residual(c.by_fit[i]) for c in study.text])) for i in range(len(study.fits))
    ]
    nearest = sorted(range(len(study.fits)), key=misses.__getitem__)[:_MOST_RANKED]
    return TextTable(
        head=(
            "mechanism",
            "free length",
            *(f"{c.figure.name} ({c.figure.value:g} {c.figure.unit})" for c in study.text),
            "rms of these / σ",
            "rms of the tables / σ",
        ),
        rows=tuple(
            (
                _starred(study.fits[i], study),
                _free_length(study.fits[i], study),
                *(value_text(c.figure, c.by_fit[i]) for c in study.text),
                f"{misses[i]:.1f}",
                f"{study.fits[i].rms_residual:.2f}",
            )
            for i in nearest
        ),
    )


def proposed_table(study: PublishedStudy) -> TextTable:
    """Predictions of the proposed experiments under each accepted explanation."""
    fits = study.plastisol.verdict.accepted
    names = [f"{names_in_words(f.hypothesis.names)}, {f.hypothesis.free_length}" for f in fits]
    return TextTable(
        head=("experiment", "measured", "separates", *names),
        rows=tuple(
            (
                f"{p.measurement.experiment.value}, {p.measurement.depth_mm / 10:g} cm",
                f"{p.measurement.quantity.value}, {p.measurement.unit}",
                f"{percent(p.separated)} of pairs",
                *(value_text(p.measurement, v) for v in p.predicted),
            )
            for p in study.proposed
        ),
    )


def compensator_table(study: PublishedStudy) -> TextTable:
    """The compensator's columns beside ours."""
    return TextTable(
        head=("figure", "free length", "published", "simulated", "ratio"),
        rows=tuple(
            (
                c.name,
                c.free_length,
                f"{c.published:g} {c.unit}",
                f"{c.simulated:.3g}",
                f"{c.simulated / c.published:.2f}",
            )
            for c in study.compensator
        ),
    )
