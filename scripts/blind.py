"""`needle blind`: how often is the diagnosis right on rigs that it has never met?"""

from collections.abc import Sequence
from pathlib import Path

import pandas as pd
from rich.console import Console
from rich.progress import track
from rich.table import Table

from benchmarks.blind import honesty, picture, score
from benchmarks.blind.detection import limits
from benchmarks.blind.make import make_logs
from benchmarks.blind.run import diagnose_all
from models.errors import InvalidValue
from sim.files import refuse_existing, write_text, writing


def make(
    folder: Path,
    *,
    seed: int,
    count: int,
    kinds: Sequence[str] | None,
    effects: Sequence[str] | None,
    signature: tuple[float, float],
    short: bool,
    console: Console,
) -> int:
    """Write logs of an independent rig, and apart from them the answers."""
    if folder.exists():
        raise InvalidValue("out", folder, "a folder that does not exist yet", "choose another one")
    try:
        make_logs(
            folder,
            seed=seed,
            count=count,
            kinds=kinds,
            effects=effects,
            signature=signature,
            short=short,
        )
    except ValueError as error:
        raise InvalidValue("arguments", str(error), "names that the maker knows") from error
    console.print(f"wrote      {folder}/logs ({count} logs)\nwrote      {folder}/answers")
    return 0


def run_score(
    folder: Path, out: Path | None, *, trials: int | None, force: bool, console: Console
) -> int:
    """Diagnose what has no report yet, then hold the reports to the answers."""
    if trials is not None and trials < 1:
        raise InvalidValue("trials", trials, "at least one", "leave it out for all")
    if not (folder / "logs").is_dir() or not (folder / "answers" / "answers.json").is_file():
        raise InvalidValue(
            "folder", folder, "a folder with logs/ and answers/answers.json", "see needle blind make"
        )
    paths = [out / name for name in ("scores.csv", "score.png")] if out else []
    refuse_existing(paths, force=force)
    reports = score.reports_in(folder, trials)
    diagnose_all(folder / "logs", reports, trials=trials, watched=lambda s: track(s, description="logs"))
    scores = score.read_scores(folder, trials)
    console.print(_table(honesty.summary(scores)))
    weak = limits(scores).dropna()
    if len(weak):
        console.print(_limits(weak))
    console.print(_goals(scores))
    for case, row in scores[~scores["exact"]].iterrows():
        console.print(f"{case}: {row['truth']}, said {row['said']} ({row['verdict']})", highlight=False)
    if paths:
        write_text(paths[0], scores.to_csv(index_label="case", float_format="%.4g"), force=force)
        with writing(paths[1], force=force) as part:
            picture.draw(scores, part)
    for path in paths:
        console.print(f"wrote      {path}", highlight=False)
    return 0


def _table(summary: pd.DataFrame) -> Table:
    table = Table("kind", "logs", "exact", "undecided", "unknown", "seconds", title="By kind of log")
    for kind, row in summary.iterrows():
        shares = [f"{100 * row[c]:.1f} %" for c in ("exact", "undecided", "unknown")]
        table.add_row(str(kind), f"{row['logs']:.0f}", *shares, f"{row['seconds']:.0f}")
    return table


def _limits(found: pd.DataFrame) -> Table:
    table = Table("effect", "logs", "named", "from", title="Detection limit, over noise")
    for effect, row in found.iterrows():
        table.add_row(
            str(effect), f"{row['logs']:.0f}", f"{100 * row['named']:.0f} %", f"{row['limit']:.2f}"
        )
    return table


def _goals(scores: pd.DataFrame) -> Table:
    table = Table("of all logs", "measured", title="Honesty")
    share, count = honesty.coverage(scores)
    table.add_row("probabilities are off by", f"{honesty.calibration_error(scores):.3f}")
    table.add_row(f"95 % intervals that cover (of {count})", f"{100 * share:.1f} %")
    table.add_row("gap left within 1.03 noise", f"{100 * honesty.gap_left(scores):.1f} %")
    below, unseen = honesty.hidden_below(scores)
    if unseen:
        told = f"effects that went unseen, as weak as the reports say may hide (of {unseen})"
        table.add_row(told, f"{100 * below:.0f} %")
    return table
