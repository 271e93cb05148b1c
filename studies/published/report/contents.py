"""The contents of `paper.json`."""

import math
from typing import Any

from models import published
from studies.published.compensator import CompensatorFigure
from studies.published.criteria import RELATIVE_SIGMA
from studies.published.experiments.measurement import MeasuredFigure
from studies.published.experiments.text_figures import TEXT_FIGURES_PLASTISOL
from studies.published.fitting.fit import FigureFit
from studies.published.insertion_study import InsertionStudy
from studies.published.material_study import MaterialStudy, TextComparison
from studies.published.report.insertion_tables import insertion_sentences
from studies.published.report.limitations import limitations
from studies.published.report.sentences import next_experiment, verdict_sentence
from studies.published.report.values import fitted_values
from studies.published.selection.assumed_sigma import consistent_sets
from studies.published.selection.discrimination import ProposedExperiment
from studies.published.selection.quick_damping import quick_damping
from studies.published.selection.twist_constraint import contradiction
from studies.published.selection.verdict import is_consistent, unresolved
from studies.published.study import PublishedStudy

FORMAT = "paper-gap/1"


def as_json(study: PublishedStudy) -> dict[str, Any]:
    """The whole study, for programs."""
    return {
        "format": FORMAT,
        "verdict": study.plastisol.verdict.kind.value,
        "sentence": verdict_sentence(study.plastisol),
        "spread_of_tables_iv_v": RELATIVE_SIGMA,
        "materials": {m.material: _material(m) for m in (study.plastisol, study.gelatin)},
        "limits": limitations(study),
        "sets_that_pass_by_spread": {
            f"{sigma:g}": count for sigma, count in consistent_sets(study.plastisol.fits).items()
        },
        "table_v_damping_share": [
            _quick_damping(f.hypothesis.base.free_mm) for f in study.plastisol.stated
        ],
        "insertions": _insertions(study.insertions),
        "compensator": [_compensator(c) for c in study.compensator],
        "next_experiments": [_proposed(p) for p in study.proposed],
        "next_experiment": next_experiment(study),
        "warnings": list(study.warnings),
    }


def _material(study: MaterialStudy) -> dict[str, Any]:
    verdict = study.verdict
    return {
        "verdict": verdict.kind.value,
        "sentence": verdict_sentence(study),
        "effects": list(verdict.effects),
        "confusable": [list(names) for names in verdict.confusable],
        "figures": [_figure(i, figure, study) for i, figure in enumerate(study.figures)],
        "candidates": [_fit(fit, study) for fit in study.fits],
        "in_words": [_text(comparison) for comparison in study.text],
    }


def _figure(i: int, figure: MeasuredFigure, study: MaterialStudy) -> dict[str, Any]:
    return {
        "name": figure.name,
        "published": figure.value,
        "unit": figure.unit,
        "spread": figure.sigma,
        "spread_from": figure.sigma_source,
        "ours": {
            fit.hypothesis.free_length: {
                "value": float(fit.predicted[i]),
                "ratio": float(fit.predicted[i] / figure.value),
                "missed_spreads": float(fit.residual[i]),
            }
            for fit in study.stated
        },
    }


def _fit(fit: FigureFit, study: MaterialStudy) -> dict[str, Any]:
    return {
        "effects": list(fit.hypothesis.names),
        "reading": fit.hypothesis.free_length,
        "accepted": fit in study.verdict.accepted,
        "meets_the_figures": is_consistent(fit),
        "contradiction": contradiction(fit),
        "parameters": fitted_values(fit),
        "gap": {
            "before": study.stated_as(fit).rms_residual,
            "after": fit.rms_residual,
            "left_out": fit.rms_left_out,
        },
        "chi_square": fit.chi_square,
        "degrees_of_freedom": fit.degrees_of_freedom,
        "p_value": fit.p_value,
        "aicc": _finite(fit.aicc),
        "figures": {f.name: float(v) for f, v in zip(fit.figures, fit.predicted, strict=True)},
        "left_out_missed_spreads": [float(z) for z in fit.left_out],
        "still_open": [f.name for f in unresolved(fit)],
        "cannot_close": [f.name for f in study.unattainable.get(fit.hypothesis, ())],
        "in_words": {c.figure.name: c.by_fit[study.fits.index(fit)] for c in study.text},
    }


def _text(comparison: TextComparison) -> dict[str, Any]:
    return {
        "name": comparison.figure.name,
        "published": comparison.figure.value,
        "unit": comparison.figure.unit,
        "stated": comparison.stated,
        "stated_yielding_tissue": comparison.yielding,
        "accepted": list(comparison.predicted),
    }


def _quick_damping(free_mm: float) -> dict[str, float]:
    found = quick_damping(free_mm)
    return {"free_mm": found.free_mm, "value": found.ratio, "spread": found.sigma}


def _insertions(study: InsertionStudy) -> dict[str, Any]:
    published_mm = (published.FIG_12_BASE_ONLY.value, published.FIG_12_COMPENSATED.value)
    return {
        "published_mm": dict(zip(("base_only", "compensated"), published_mm, strict=True)),
        "half_turns": "to and fro",
        "stated_one_way_mm": dict(zip(("base_only", "compensated"), study.one_way_mm, strict=True)),
        "sentences": insertion_sentences(study),
        "hypotheses": [
            {
                "name": p.hypothesis.name,
                "basis": p.hypothesis.basis,
                "value": _finite(p.value),
                "unit": p.hypothesis.parameter.unit if p.hypothesis.parameter else "",
                "base_only_mm": p.alone_mm,
                "compensated_mm": p.compensated_mm,
                "rms_residual": p.rms_residual,
                "meets_both": p.meets_both,
                "in_words": {f.name: v for f, v in zip(TEXT_FIGURES_PLASTISOL, p.text, strict=True)},
                "worse_than_stated": list(study.worsened(p)),
            }
            for p in study.predictions
        ],
    }


def _compensator(figure: CompensatorFigure) -> dict[str, Any]:
    return {
        "name": figure.name,
        "reading": figure.free_length,
        "published": figure.published,
        "ours": figure.simulated,
        "unit": figure.unit,
        "ratio": _finite(figure.simulated / figure.published),
    }


def _proposed(proposed: ProposedExperiment) -> dict[str, Any]:
    measurement = proposed.measurement
    return {
        "experiment": measurement.experiment.value,
        "measure": measurement.quantity.value,
        "depth_mm": measurement.depth_mm,
        "unit": measurement.unit,
        "spread": measurement.sigma,
        "predicted": list(proposed.predicted),
        "tells_apart": proposed.separated,
    }


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
