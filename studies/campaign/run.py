"""Runs the missing pieces of a campaign."""

import time
from collections.abc import Callable
from dataclasses import dataclass

from diagnosis.engines.engine import Engine
from diagnosis.progress import Progress
from models.errors import InvalidValue
from studies.campaign.cases import check_values
from studies.campaign.columns import FAILED
from studies.campaign.results import ResultFolder
from studies.campaign.run_case import job_of


@dataclass(frozen=True, kw_only=True)
class Finished:
    """Number of cases that were computed now, and how many of them failed."""

    computed: int
    failed: int
    seconds_s: float


def run_campaign(
    results: ResultFolder,
    engine: Engine,
    *,
    resume: bool = False,
    force: bool = False,
    progress: Callable[[Progress], None],
) -> Finished:
    """Compute and write the pieces that are missing.

    Args:
      resume, force: see `ResultFolder.begin`.
      progress: called after every piece.

    Raises:
      NeedleError: the campaign cannot run, or the folder has other results; nothing is lost.
    """
    check_values(results.campaign)
    results.begin(resume=resume, force=force)
    missing = results.missing()
    cases, done, failed = sum(map(len, missing)), 0, 0
    began_s = time.monotonic()

    def tell() -> None:
        elapsed_s = time.monotonic() - began_s
        left_s = elapsed_s * (cases - done) / done if done else 0.0
        stage = f"{results.campaign.kind.value} cases ({failed} failed)"
        progress(
            Progress(
                stage=stage,
                done=done,
                tasks=cases,
                elapsed_s=elapsed_s,
                left_s=(left_s, left_s) if done else None,
            )
        )

    tell()
    for piece, rows in engine(job_of(results.campaign), missing):
        results.write(piece, rows)
        done += len(rows)
        failed += sum(row["status"] == FAILED for row in rows)
        tell()
    if left := results.missing():
        raise InvalidValue(
            str(results.dataset), f"{len(left)} missing", "all pieces", "run it again with --resume"
        )
    return Finished(computed=done, failed=failed, seconds_s=time.monotonic() - began_s)
