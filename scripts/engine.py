"""The engine that the command line selects."""

import os

from rich.console import Console

from diagnosis.engines.cluster import on_cluster
from diagnosis.engines.engine import Engine
from diagnosis.engines.local import on_this_machine


def engine_of(workers: int | None, scheduler: str | None, shown: Console) -> Engine:
    """A cluster, if the address of its scheduler is given; else processes, by default one per core.

    Args:
      shown: shows news of the connection.
    """
    if scheduler is None:
        return on_this_machine(workers or os.cpu_count() or 1)
    return on_cluster(scheduler, tell=lambda news: shown.print(news, highlight=False, markup=False))
