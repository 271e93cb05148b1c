"""Who computes the pieces of a campaign: processes of this machine.

An engine yields every piece with its rows as soon as they are there, in any order. Nothing depends on
which one it is: a piece is the same wherever it is computed.
"""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import as_completed
from concurrent.futures.process import BrokenProcessPool

from diagnosis.workers import process_pool
from models.errors import NeedleError
from sim.simulation import prepare_processes
from studies.campaign.campaign import Campaign
from studies.campaign.columns import Row
from studies.campaign.run_case import rows_of

Piece = tuple[range, list[Row]]
Engine = Callable[[Campaign, Sequence[range]], Iterator[Piece]]
"""From a campaign and the pieces to compute to their rows."""

MOST_LOSSES = 3  # of workers in a row, without a piece in between: it is no accident


class EngineFailed(NeedleError):
    """Nobody is left who could compute."""


def on_this_machine(workers: int) -> Engine:
    """Processes of this machine, which end with this one, however it ends.

    If one dies, the others are ended too, and what is not there yet is computed by new ones.
    """

    def compute(campaign: Campaign, wanted: Sequence[range]) -> Iterator[Piece]:
        prepare_processes()
        missing, losses = list(wanted), 0
        while missing:
            try:
                for piece, rows in _until_one_dies(campaign, missing, workers):
                    missing.remove(piece)
                    losses = 0
                    yield piece, rows
            except BrokenProcessPool:
                losses += 1
                refuse_more_losses(losses, missing)

    return compute


def refuse_more_losses(losses: int, missing: Sequence[range]) -> None:
    """Raise where workers die of what they compute.

    Raises:
      EngineFailed: names cases that are missing.
    """
    if losses >= MOST_LOSSES:
        first = missing[0]
        raise EngineFailed(
            f"workers ended {losses} times without completing a piece; cases {first.start} to "
            f"{first.stop - 1} are among the missing ones: look for a lack of memory there, take "
            "smaller pieces (cases_per_piece) or fewer workers; --resume goes on with what is complete"
        )


def _until_one_dies(campaign: Campaign, pieces: Sequence[range], workers: int) -> Iterator[Piece]:
    with process_pool(min(workers, len(pieces))) as crew:
        if crew.pool is None:
            yield from ((piece, rows_of(campaign, piece)) for piece in list(pieces))
            return
        calls = {crew.pool.submit(rows_of, campaign, piece): piece for piece in pieces}
        for call in as_completed(calls):
            yield calls.pop(call), call.result()
