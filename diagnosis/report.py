"""A diagnosis as files: `report.json`, `report.html`, `gap.rrd`, `predictions/` (gap-report/1)."""

import json
from pathlib import Path
from typing import Any

import pandas as pd

from diagnosis.diagnose import Diagnosis
from diagnosis.gap_recording import log_gap
from diagnosis.held_out import intervals
from diagnosis.page import page, sentence
from diagnosis.rig_log import RigLog
from diagnosis.verdict import Outcome, places
from sim.files import refuse_existing, write_text

FORMAT = "gap-report/1"


def as_json(diagnosis: Diagnosis) -> dict[str, Any]:
    """The contract: every key of gap-report/1, plain values."""
    verdict, gap, where = diagnosis.verdict, diagnosis.gap, diagnosis.where
    return {
        "format": FORMAT,
        "verdict": verdict.outcome.value,
        "effects": list(verdict.effects),
        "confusable": [list(names) for names in verdict.confusable],
        "ranking": [{"effect": n, "probability": p} for n, p in verdict.ranking],
        "parameters": parameters(diagnosis),
        "gap": {
            "before": gap.before,
            "after": gap.after,
            "noise": 1.0,
            "shrink": gap.shrink,
            "shrink_low": gap.shrink_low,
            "shrink_high": gap.shrink_high,
        },
        "where": {
            "signal": where.signal,
            "phase": where.phase,
            "band_hz": [list(b) for b in where.band_hz],
            "depth_mm": [list(d) for d in where.depth_mm],
            "place": places(verdict.effects),
        },
        "next_experiment": next_experiment(diagnosis),
        "warnings": list(diagnosis.noise.warnings),
    }


def parameters(diagnosis: Diagnosis) -> dict[str, dict[str, dict[str, Any]]]:
    """Accepted effects' parameters with 95 % intervals, in the vocabulary's units."""
    fit = diagnosis.verdict.best.fit
    found: dict[str, dict[str, dict[str, Any]]] = {}
    values = iter(intervals(fit))
    for effect in (*fit.coordinates.effects, *fit.coordinates.nuisance):
        mine = {p.name: (p.unit, next(values)) for p in effect.parameters}
        if effect.name in diagnosis.verdict.effects:
            found[effect.name] = {
                name: {"value": v, "low": low, "high": high, "unit": unit}
                for name, (unit, (v, low, high)) in mine.items()
            }
    return found


def next_experiment(diagnosis: Diagnosis) -> str:
    """What to run next; empty where nothing is left to tell apart."""
    verdict = diagnosis.verdict
    if verdict.outcome is Outcome.UNKNOWN:
        worst = max(diagnosis.where.phase, key=lambda k: diagnosis.where.phase[k], default="")
        signal = max(diagnosis.where.signal, key=lambda k: diagnosis.where.signal[k], default="")
        return (
            f"no effect of the library explains the gap; it is largest in {signal} while {worst}: "
            "repeat that phase alone, at two depths and two rates"
        )
    if verdict.outcome is Outcome.UNDECIDED:
        sets = " and ".join(" + ".join(names) for names in verdict.confusable)
        return f"{sets} fit alike: add trials at another depth, another rate and with the needle sliding"
    return ""


def output_paths(log: RigLog, folder: Path) -> list[Path]:
    """What `write_report` will write."""
    whole = [folder / name for name in ("report.json", "report.html", "gap.rrd")]
    return [*whole, *(folder / "predictions" / t.name for t in log.trials)]


def write_report(diagnosis: Diagnosis, folder: Path, *, force: bool = False) -> list[Path]:
    """Write everything, `report.json` last; returns the paths.

    Raises:
      OutputExists: one of them exists and `force` is not given.
    """
    paths = output_paths(diagnosis.log, folder)
    refuse_existing(paths, force=force)
    log = diagnosis.log
    report = as_json(diagnosis)
    each = zip(log.trials, diagnosis.nominal, diagnosis.explained, paths[3:], strict=True)
    for trial, nominal, explained, path in each:
        columns = {"time_s": trial["time_s"]}
        for sensor in ("base_torque_n_mm", "tip_angle_deg"):
            columns[f"{sensor}_nominal"] = nominal[sensor]
            columns[f"{sensor}_explained"] = explained[sensor]
        text = pd.DataFrame(columns).to_csv(index=False, float_format="%.6g")
        write_text(path, text, force=force)
    log_gap(diagnosis, sentence(diagnosis), paths[2], force=force)
    write_text(paths[1], page(diagnosis, report), force=force)
    write_text(paths[0], json.dumps(report, indent=1, allow_nan=False), force=force)
    return paths
