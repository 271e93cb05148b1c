"""`paper.json`: what the published figures say, and how much they can."""

import json
import math
from pathlib import Path
from typing import Any

from sim.files import refuse_existing, write_text
from studies.published.experiments.figures import FRACTION
from studies.published.fitting.fit import Fit, rms
from studies.published.report.page import page
from studies.published.report.sentences import limits, next_experiment, parameters, sentence
from studies.published.selection.discrimination import Prospect
from studies.published.selection.scatter import damping_share, sets_that_pass
from studies.published.selection.verdict import contradiction, meets, still_open
from studies.published.study import Case, Study

FORMAT = "paper-gap/1"


def as_json(study: Study) -> dict[str, Any]:
    """The contents of paper.json."""
    return {
        "format": FORMAT,
        "verdict": study.plastisol.verdict.outcome.value,
        "sentence": sentence(study.plastisol),
        "spread_of_tables_iv_v": FRACTION,
        "materials": {c.material: _case(c) for c in (study.plastisol, study.gelatin)},
        "limits": limits(study),
        "sets_that_pass_by_spread": {
            f"{fraction:g}": n for fraction, n in sets_that_pass(study.plastisol.fits).items()
        },
        "table_v_damping_share": [
            vars(damping_share(f.hypothesis.base.free_mm)) for f in study.plastisol.stated
        ],
        "compensator": [vars(c) | {"ratio": _finite(c.ours / c.published)} for c in study.compensated],
        "next_experiments": [_prospect(p) for p in study.prospects],
        "next_experiment": next_experiment(study),
        "warnings": list(study.warnings),
    }


def _case(case: Case) -> dict[str, Any]:
    verdict = case.verdict
    return {
        "verdict": verdict.outcome.value,
        "sentence": sentence(case),
        "effects": list(verdict.effects),
        "confusable": [list(names) for names in verdict.confusable],
        "figures": [
            {
                "name": f.name,
                "published": f.value,
                "unit": f.unit,
                "spread": f.spread,
                "spread_from": f.why,
                "ours": {
                    s.hypothesis.reading: {
                        "value": float(s.predicted[i]),
                        "ratio": float(s.predicted[i] / f.value),
                        "missed_spreads": float(s.missed[i]),
                    }
                    for s in case.stated
                },
            }
            for i, f in enumerate(case.figures)
        ],
        "candidates": [_fit(f, case) for f in case.fits],
        "in_words": [
            {
                "name": w.figure.name,
                "published": w.figure.value,
                "unit": w.figure.unit,
                "stated": w.stated,
                "accepted": list(w.predicted),
            }
            for w in case.in_words
        ],
    }


def _fit(fit: Fit, case: Case) -> dict[str, Any]:
    before = _before(fit, case)
    return {
        "effects": list(fit.hypothesis.names),
        "reading": fit.hypothesis.reading,
        "accepted": fit in case.verdict.accepted,
        "meets_the_figures": meets(fit),
        "contradiction": contradiction(fit),
        "parameters": parameters(fit),
        "gap": {"before": before.gap, "after": fit.gap, "left_out": rms(fit.left_out)},
        "chi_square": fit.chi_square,
        "degrees_of_freedom": fit.freedom,
        "p_value": fit.p_value,
        "aicc": _finite(fit.aicc),
        "figures": {f.name: float(v) for f, v in zip(fit.figures, fit.predicted, strict=True)},
        "left_out_missed_spreads": [float(z) for z in fit.left_out],
        "still_open": [f.name for f in still_open(fit)],
        "cannot_close": [f.name for f in case.beyond.get(fit.hypothesis, ())],
    }


def _before(fit: Fit, case: Case) -> Fit:
    """The stated rig in the reading of a fit."""
    return next(s for s in case.stated if s.hypothesis.base == fit.hypothesis.base)


def _prospect(prospect: Prospect) -> dict[str, Any]:
    return {
        "experiment": prospect.figure.experiment.value,
        "measure": prospect.figure.measure.value,
        "depth_mm": prospect.figure.depth_mm,
        "unit": prospect.figure.unit,
        "spread": prospect.figure.spread,
        "predicted": list(prospect.predicted),
        "tells_apart": prospect.apart,
    }


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def output_paths(folder: Path) -> list[Path]:
    """What `write_report` will write."""
    return [folder / "paper.html", folder / "paper.json"]


def write_report(study: Study, folder: Path, *, force: bool = False) -> list[Path]:
    """Write page and JSON, the JSON last; returns the paths.

    Raises:
      OutputExists: one of them exists and `force` is not given.
    """
    paths = output_paths(folder)
    refuse_existing(paths, force=force)
    write_text(paths[0], page(study), force=force)
    write_text(paths[1], json.dumps(as_json(study), indent=1, allow_nan=False), force=force)
    return paths
