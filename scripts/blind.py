"""`needle blind`: how often is the diagnosis right on rigs that it has never seen?"""

import json
import math
from collections.abc import Sequence
from functools import partial
from pathlib import Path

import pandas as pd
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Column, Table

from models.errors import InvalidValue, NeedleError, UnknownName
from models.names import is_file, is_folder
from scripts.engine import engine_of
from scripts.output_folder import first_free, output_folder
from scripts.progress_line import by_count, counted, progress_line
from scripts.results import tell
from scripts.tables import print_table
from scripts.terminal import terminal
from sim.files import Destination, ResultSet, publishing, write_text
from validation.logs.case import ImpossibleDraw
from validation.logs.make import NAMES, make_logs
from validation.score import calibration, picture
from validation.score.detection import detection_limits
from validation.score.json_summary import as_json
from validation.score.missing import CLOSED, ELSEWHERE_GOAL, missing_summary
from validation.score.run import score_logs

KNOWN_NAMES = NAMES
"""What --kinds, --effects and --roughness may name."""
MADE, SCORED = Path("out/blind"), Path("out/score")


def make(
    out: Path | None,
    *,
    seed: int,
    count: int,
    kinds: Sequence[str] | None,
    effects: Sequence[str] | None,
    roughness: Sequence[str] | None,
    signature: tuple[float, float],
    short: bool,
    console: Console,
) -> int:
    """Write logs of an independent rig, and their ground truth separately.

    Raises:
      NeedleError: the folder exists, or an argument is not what `make_logs` takes.
    """
    for field, given in (("kinds", kinds), ("effects", effects), ("roughness", roughness)):
        _check_names(f"--{field}", given or (), KNOWN_NAMES[field])
    if out and out.exists():
        raise InvalidValue("--out", out, "a folder that does not exist yet", "choose another one")
    folder = out or first_free(MADE, lambda to: [to])
    try:
        with (
            progress_line(terminal(stderr=True)) as show,
            publishing(Destination(folder=folder.parent), [folder]) as written,
        ):
            make_logs(
                written.at(folder),
                seed=seed,
                count=count,
                kinds=kinds,
                effects=effects,
                roughness=roughness,
                signature=signature,
                short=short,
                watched=lambda made: counted(made, count, "making logs", show),
            )
    except (ValueError, ImpossibleDraw) as error:
        raise NeedleError(str(error)) from error
    logs = "1 log" if count == 1 else f"{count} logs"
    shown: list[Path | str] = [f"{folder / 'logs'} ({logs})", folder / "answers"]
    return tell(written, console, shown=shown)


def _check_names(field: str, given: Sequence[str], known: Sequence[str]) -> None:
    for name in given:
        if name not in known:
            raise UnknownName(field, name, known)


def run_score(
    folder: Path,
    out: Path | None,
    *,
    trials: int | None,
    limit_s: float | None,
    workers: int | None = None,
    scheduler: str | None = None,
    force: bool,
    console: Console,
) -> int:
    """Diagnose the logs that have no report yet, then compare the reports with the ground truth.

    Raises:
      InvalidValue: `trials` or the limit is out of range, or the folder has no logs or no usable
        ground truth.
      EngineFailed: no worker is left; the reports so far are kept.
    """
    if trials is not None and trials < 1:
        raise InvalidValue("--trials", trials, "at least 1", "leave it out for all trials")
    if limit_s is not None and not limit_s > 0:
        raise InvalidValue("--limit", limit_s, "seconds above 0", "leave it out for no limit")
    if not is_folder(folder / "logs") or not is_file(folder / "answers" / "answers.json"):
        raise InvalidValue(
            "DIR", folder, "a folder with logs/ and answers/answers.json", "see needle blind make"
        )
    inputs = tuple(path for room in ("logs", "answers") for path in (folder / room).rglob("*"))
    destination = output_folder(out, SCORED, _score_paths, inputs=inputs, force=force)
    shown = terminal(stderr=True)
    engine = engine_of(workers, scheduler, shown)
    with progress_line(shown) as show:
        told = by_count(show)
        scores = score_logs(folder, engine=engine, trials=trials, limit_s=limit_s, progress=told)
    written = _write(scores, destination)
    _print(scores, console)
    return tell(written, console)


def _write(scores: pd.DataFrame, destination: Destination) -> ResultSet:
    table, summary, shown = paths = _score_paths(destination.folder)
    with publishing(destination, paths) as written:
        text = scores.to_csv(index_label="case", float_format="%.4g")
        write_text(written.at(table), text)
        write_text(written.at(summary), json.dumps(as_json(scores), indent=1, allow_nan=False) + "\n")
        written.optional(shown, partial(picture.draw, scores))
    return written


def _score_paths(folder: Path) -> list[Path]:
    return [folder / name for name in ("scores.csv", "score.json", "score.png")]


def _print(scores: pd.DataFrame, console: Console) -> None:
    wrong = calibration.confidently_wrong(scores)
    by_kind = [calibration.summary(scores), calibration.summary(scores.assign(kind="all"))]
    print_table(console, _by_kind(pd.concat(by_kind)))
    _list(scores[wrong], "confidently wrong: ", console)
    limits = detection_limits(scores).dropna()
    if len(limits):
        print_table(console, _limits(limits))
    print_table(console, _calibration(scores))
    if scores["missing_told"].any() or scores["missing_said"].any():
        print_table(console, _missing(scores))
    _list(scores[~scores["exact"] & ~wrong], "not exact: ", console)


def _list(scores: pd.DataFrame, what: str, console: Console) -> None:
    for case, row in scores.iterrows():
        verdict = "" if row["said"] == row["verdict"] else f" ({row['verdict']})"
        line = f"{what}{case}: true {row['truth']}, diagnosed {row['said']}{verdict}"
        console.print(line, highlight=False)


def _by_kind(summary: pd.DataFrame) -> Table:
    shares = ("exact\n%", "undecided\n%", "unknown\n%")
    shown = ("logs", "confidently\nwrong", *shares, "median\ns", "worst\ns")
    kind_column = Column("kind", no_wrap=True)
    table = Table(kind_column, *shown, title="By kind of log", box=SIMPLE_HEAD, padding=(0, 1, 0, 0))
    for kind, row in summary.iterrows():
        percent = [f"{100 * row[c]:.1f}" for c in ("exact", "undecided", "unknown")]
        counts = [f"{row[c]:.0f}" for c in ("logs", "confidently_wrong")]
        seconds = [f"{row[c]:.0f}" for c in ("seconds", "worst_seconds")]
        table.add_row(str(kind), *counts, *percent, *seconds)
    return table


def _limits(limits: pd.DataFrame) -> Table:
    title = "Detection limits: signature (rms of the effect / σ) from which it is named"
    table = Table("effect", "logs", "named", "limit", title=title)
    for effect, row in limits.iterrows():
        table.add_row(
            str(effect), f"{row['logs']:.0f}", f"{100 * row['named']:.0f} %", f"{row['limit']:.2f}"
        )
    return table


def _calibration(scores: pd.DataFrame) -> Table:
    table = Table("all logs", "measured", title="Calibration")
    share, count = calibration.coverage(scores)
    chance = calibration.calibration_error_by_chance(scores)
    table.add_row(
        f"calibration error of the probabilities (by chance, if all were right: {chance:.3f})",
        f"{calibration.calibration_error(scores):.3f}",
    )
    table.add_row(f"95 % intervals that contain the true value (of {count})", _percent(share))
    table.add_row(
        f"exact diagnoses with a residual of at most {calibration.GAP_GOAL} σ",
        _percent(calibration.gap_left(scores)),
    )
    below, unseen = calibration.undetected_within_limit(scores)
    if unseen:
        row = f"undetected effects that are below the reported detection limit (of {unseen})"
        table.add_row(row, f"{100 * below:.0f} %")
    return table


def _missing(scores: pd.DataFrame) -> Table:
    counted = missing_summary(scores)
    rows = {
        "said": "reports that say what is missing, of logs outside of the library",
        "place_right": "of these: likeliest place right",
        "variable_right": "of these: first variable right",
        "closed": f"of these: its law leaves at most {CLOSED} σ on trials that it has not seen",
        "elsewhere": f"reports that say so of other logs (goal: {100 * ELSEWHERE_GOAL:.0f} % or less)",
    }
    table = Table("what is missing", "reports", "share", title="Outside of the library")
    for name, row in rows.items():
        some, of = counted[name]
        table.add_row(row, f"{some} of {of}", _percent(some / of if of else math.nan))
    return table


def _percent(share: float) -> str:
    """A share in words; NaN: of none."""
    return "–" if math.isnan(share) else f"{100 * share:.1f} %"
