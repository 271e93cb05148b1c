"""A diagnosis as files: `report.json`, `report.html`, `gap.rrd`, `predictions/` (gap-report/1)."""

import json
from dataclasses import asdict
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pandas as pd

from diagnosis.candidate import Candidate
from diagnosis.diagnose import Diagnosis
from diagnosis.gap_recording import log_gap
from diagnosis.limits import cannot_tell
from diagnosis.page import page, sentence
from diagnosis.rig_log import RigLog
from diagnosis.verdict import places
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
        "parameters": {
            effect: {name: asdict(interval) for name, interval in own.items()}
            for effect, own in diagnosis.parameters.items()
        },
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
            "time_s": [list(t) for t in where.time_s],
            "place": places(verdict.effects),
        },
        "next_experiment": diagnosis.next_experiment,
        "floor": _floor(verdict.best),
        "further": diagnosis.further,
        "hidden": diagnosis.hidden,
        "cannot_tell": list(cannot_tell(diagnosis.log)),
        "replay_error": diagnosis.replay_error,
        "noise": diagnosis.noise.sigma,
        "warnings": list(diagnosis.warnings),
    }


def _floor(best: Candidate) -> dict[str, Any]:
    """How near the noise floor the best explanation is, where it was fitted and where not."""
    unseen = asdict(best.unseen) if best.unseen else None
    return {"fitted": asdict(best.floor), "unseen": unseen, "surprise": best.surprise}


def output_paths(log: RigLog, folder: Path) -> list[Path]:
    """What `write_report` will write."""
    whole = [folder / name for name in ("report.json", "report.html", "gap.rrd")]
    return [*whole, *(folder / "predictions" / t.name for t in log.trials)]


def write_report(diagnosis: Diagnosis, folder: Path, *, force: bool = False) -> list[Path]:
    """Write everything, or nothing if it is interrupted; returns the paths.

    Raises:
      OutputExists: one of them exists and `force` is not given.
    """
    paths = output_paths(diagnosis.log, folder)
    refuse_existing(paths, force=force)
    folder.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory(prefix=".report-", dir=folder) as hidden:
        drafts = output_paths(diagnosis.log, Path(hidden))
        _write_drafts(diagnosis, drafts)
        for draft, path in zip(drafts, paths, strict=True):
            path.parent.mkdir(exist_ok=True)
            draft.replace(path)
    return paths


def _write_drafts(diagnosis: Diagnosis, paths: list[Path]) -> None:
    log, report = diagnosis.log, as_json(diagnosis)
    write_text(paths[0], json.dumps(report, indent=1, allow_nan=False))
    write_text(paths[1], page(diagnosis, report))
    log_gap(diagnosis, sentence(diagnosis), paths[2])
    each = zip(log.trials, diagnosis.nominal, diagnosis.explained, paths[3:], strict=True)
    for trial, nominal, explained, path in each:
        columns = {"time_s": trial["time_s"]}
        for sensor in ("base_torque_n_mm", "tip_angle_deg"):
            columns[f"{sensor}_nominal"] = nominal[sensor]
            columns[f"{sensor}_explained"] = explained[sensor]
        write_text(path, pd.DataFrame(columns).to_csv(index=False, float_format="%.6g"))
