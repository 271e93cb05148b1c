"""The pieces of a campaign on an existing cluster of `dask.distributed`.

Workers have this product installed. A worker that is lost costs nothing: the scheduler gives its piece
to another. If the scheduler is lost, this end waits for it to come back and asks for what is missing.
"""

import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import CancelledError
from typing import Any

from models.errors import EnvironmentMismatch, InvalidValue
from studies.campaign.campaign import Campaign
from studies.campaign.columns import Row
from studies.campaign.engines import Engine, EngineFailed, Piece, refuse_more_losses
from studies.campaign.run_case import rows_of

PATIENCE_S = 600.0  # for a scheduler that restarts
_TRY_FOR_S = 5.0  # to connect, before the next try


def _unheard(news: str) -> None:
    """What happens to the connection, told to nobody."""


def on_cluster(
    address: str, *, patience_s: float = PATIENCE_S, tell: Callable[[str], None] = _unheard
) -> Engine:
    """The workers of a scheduler.

    Args:
      address: of the scheduler, as `tcp://host:8786`.
      patience_s: how long to wait for the scheduler, at first and whenever it is lost.
      tell: is told what happens to the connection.

    Raises:
      InvalidValue: dask.distributed is not installed here.
    """
    try:
        import distributed  # noqa: F401, PLC0415 - an optional extra
    except ImportError as error:
        fix = "pip install 'needle-torsion[cluster]', here and on the workers"
        raise InvalidValue("scheduler", address, "dask.distributed to be installed", fix) from error

    def compute(campaign: Campaign, wanted: Sequence[range]) -> Iterator[Piece]:
        missing, losses = list(wanted), 0
        while missing:
            client = _connected(address, patience_s)
            if not client.scheduler_info()["workers"]:
                tell(f"the scheduler {address} has no workers yet; waiting for them")
            try:
                for piece, rows in _until_lost(client, campaign, missing):
                    missing.remove(piece)
                    losses = 0
                    yield piece, rows
            finally:
                client.close(timeout=_TRY_FOR_S)
            if missing:
                losses += 1
                refuse_more_losses(losses, missing)
                tell(f"lost the scheduler {address}; waiting up to {patience_s:g} s for it")

    return compute


def _connected(address: str, patience_s: float) -> Any:
    """A client of the scheduler, as soon as there is one.

    Raises:
      EngineFailed: there is none in time.
    """
    from distributed import Client  # noqa: PLC0415 - an optional extra

    deadline = time.monotonic() + patience_s
    while True:
        try:
            return Client(address, timeout=_TRY_FOR_S, set_as_default=False)
        except OSError as error:
            if time.monotonic() > deadline:
                raise EngineFailed(
                    f"expected a scheduler at {address}, found none for {patience_s:g} s; what is "
                    "complete is kept: start the scheduler and its workers, then --resume goes on"
                ) from error
            time.sleep(min(1.0, _TRY_FOR_S))


def _until_lost(client: Any, campaign: Campaign, pieces: Sequence[range]) -> Iterator[Piece]:
    """Pieces as they come; ends early where the connection is lost."""
    from distributed import KilledWorker, as_completed  # noqa: PLC0415 - an optional extra

    fingerprint = campaign.fingerprint
    calls = {
        client.submit(rows_on_worker, campaign, piece, fingerprint, pure=False): piece
        for piece in pieces
    }
    for call in as_completed(list(calls), loop=client.loop):
        piece = calls.pop(call)
        try:
            rows = call.result()
        except CancelledError:
            return
        except KilledWorker as killed:
            raise EngineFailed(
                f"cases {piece.start} to {piece.stop - 1} have cost several workers: look for a lack of "
                "memory there, or take smaller pieces (cases_per_piece); --resume goes on"
            ) from killed
        yield piece, rows


def rows_on_worker(campaign: Campaign, numbers: range, fingerprint: str) -> list[Row]:
    """Rows of a piece, if they are the same here.

    Raises:
      EnvironmentMismatch: this worker would compute another campaign.
    """
    if campaign.fingerprint != fingerprint:
        raise EnvironmentMismatch(
            f"expected the fingerprint {fingerprint} of the campaign, found {campaign.fingerprint}: "
            "install the same versions of needle-torsion and MuJoCo on the worker as here"
        )
    return rows_of(campaign, numbers)
