"""`needle campaign`: sweeps and Monte-Carlo runs from one file."""

from pathlib import Path

import pandas as pd
from rich.console import Console
from rich.table import Table
from rich.text import Text

from diagnosis.stopping import NEVER
from scripts.engine import engine_of
from scripts.output_folder import first_free, latest
from scripts.progress_line import progress_line
from scripts.tables import print_table
from scripts.terminal import terminal
from studies.campaign.campaign import Campaign, read_campaign
from studies.campaign.columns import FAILED
from studies.campaign.posterior.bands import QUANTILES
from studies.campaign.results import ResultFolder
from studies.campaign.run import run_campaign
from studies.campaign.summary import summarise, summary_table, tip_error_bands

_SHOWN = ["cases", "mean", "sd", "p2.5", "median", "p97.5"]
_ERRORS_SHOWN, _MOMENTS_SHOWN = 3, 10


def run(
    path: Path,
    out: Path | None,
    *,
    samples: int | None,
    resume: bool,
    workers: int | None,
    scheduler: str | None,
    force: bool,
    console: Console,
) -> int:
    """Run the missing cases of a campaign, then summarise it.

    Raises:
      NeedleError: the campaign is impossible, or the folder belongs to another one.
    """
    campaign = read_campaign(path, samples=samples)
    folder = out or _default_folder(campaign, resume=resume, force=force)
    results = ResultFolder(folder=folder, campaign=campaign)
    shown = terminal(stderr=True)
    with progress_line(shown, NEVER) as show:
        done = run_campaign(
            results, engine_of(workers, scheduler, shown), resume=resume, force=force, progress=show
        )
    console.print(f"{done.computed} cases in {done.seconds_s:.1f} s, {done.failed} failed")
    _show(results, console)
    for written in (results.folder / "campaign.yaml", results.dataset, *summarise(results)):
        console.print(f"wrote      {written}", highlight=False)
    return 0


def _default_folder(campaign: Campaign, *, resume: bool, force: bool) -> Path:
    """The folder named after the campaign; numbered if another run uses it, unless that is continued."""

    def there(folder: Path) -> ResultFolder:
        return ResultFolder(folder=folder, campaign=campaign)

    default = Path("out") / campaign.name
    if resume:
        return latest(default, lambda folder: there(folder).begun_at_s)
    return default if force else first_free(default, lambda folder: there(folder).outputs)


def _show(results: ResultFolder, console: Console) -> None:
    rows = results.read()
    table = Table("result", *_SHOWN, title=Text(results.campaign.name))
    for name, row in summary_table(results, rows).iterrows():
        table.add_row(str(name), *(f"{row[column]:.4g}" for column in _SHOWN))
    print_table(console, table)
    if results.campaign.posterior:
        _show_bands(tip_error_bands(results.campaign, rows), console)
    _show_failed(rows[rows["status"] == FAILED], console)


def _show_bands(table: pd.DataFrame, console: Console) -> None:
    moments = table.iloc[:: max(1, len(table) // _MOMENTS_SHOWN)]
    shown = Table("time, s", "base", "nominal rig", *(name.removesuffix("_deg") for name in QUANTILES))
    shown.title = "Tip error (base minus tip) of the drawn rigs, deg"
    for _, row in moments.iterrows():
        cells = (row["base_angle_deg"], row["nominal_deg"], *(row[name] for name in QUANTILES))
        shown.add_row(f"{row['time_s']:.2f}", *(f"{value:.2f}" for value in cells))
    print_table(console, shown)


def _show_failed(failed: pd.DataFrame, console: Console) -> None:
    for _, row in failed.head(_ERRORS_SHOWN).iterrows():
        console.print(f"failed: case {row['case']}: {row['error']}", highlight=False, markup=False)
    if len(failed) > _ERRORS_SHOWN:
        console.print(
            f"and {len(failed) - _ERRORS_SHOWN} more failed cases: see the column 'error' of the results"
        )
