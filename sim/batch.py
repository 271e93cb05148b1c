"""Many insertions in one call, with different tissues, needles and motions; one thread per core.

Insertions with the same model size and number of steps share a batch of MuJoCo. A thread that steps a
batch releases Python's lock, so that others can compile models meanwhile. Results do not depend on
which insertions share a batch.
"""

import os
import typing
from collections import defaultdict
from collections.abc import Hashable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import mujoco

from models.errors import NeedleError
from sim.needles.run import Run, SimulationFailed
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import prepare_processes, simulate

_SIDE_BY_SIDE = 8  # needles of one batch: few enough to share out evenly, many enough to pay


class Insertion(typing.Protocol):
    """Anything that can be simulated: it gives a set-up and inputs, as a protocol does."""

    def setup(self) -> Setup:
        """The model of the needle."""
        ...

    def schedule(self) -> Schedule:
        """The inputs over time."""
        ...


@dataclass(frozen=True, kw_only=True)
class _Ready:
    """Model and inputs of an insertion, and its index in the call."""

    place: int
    setup: Setup
    inputs: Schedule

    @property
    def size(self) -> Hashable:
        """Key that all insertions of one batch share."""
        discretisation = self.setup.discretisation
        return discretisation, self.setup.size, self.inputs.steps(discretisation.step_s)


def simulate_each(
    insertions: Sequence[Insertion], *, threads: int | None = None
) -> list[Run | NeedleError]:
    """Simulate insertions (such as protocols), which may differ in everything, independently.

    Args:
      threads: None: one per core. Results are bit-identical for any number.

    Returns:
      For each insertion, in order, its run or the error: `SimulationFailed`, or `InvalidValue` if no
      model can be made of it.
    """
    prepare_processes()
    count = threads or os.cpu_count() or 1
    found: list[Run | NeedleError] = [SimulationFailed("not simulated")] * len(insertions)
    batches = _batches(insertions, found)
    with ThreadPoolExecutor(count) as pool:
        # A pool takes batches as soon as they are full: models of one are made while others step.
        each = map(_placed, batches) if count == 1 else pool.map(_placed, batches)
        for placed in each:
            for place, result in placed:
                found[place] = result
    return found


def _batches(insertions: Sequence[Insertion], found: list[Run | NeedleError]) -> Iterator[list[_Ready]]:
    """Full batches of insertions of one size, then the rest; errors of set-ups go into `found`."""
    waiting: dict[Hashable, list[_Ready]] = defaultdict(list)
    for place, insertion in enumerate(insertions):
        try:
            one = _Ready(place=place, setup=insertion.setup(), inputs=insertion.schedule())
            waiting[one.size].append(one)
        except NeedleError as refused:
            found[place] = refused
            continue
        if len(waiting[one.size]) == _SIDE_BY_SIDE:
            yield waiting.pop(one.size)
    yield from waiting.values()


def _placed(batch: Sequence[_Ready]) -> list[tuple[int, Run | NeedleError]]:
    """Results of a batch with their indices in the call."""
    return [(one.place, result) for one, result in zip(batch, _simulated(batch), strict=True)]


def _simulated(batch: Sequence[_Ready]) -> list[Run | NeedleError]:
    """Runs of a batch; if it fails, it is halved until the failing insertion is alone with its error."""
    try:
        return list(simulate([one.setup for one in batch], [one.inputs for one in batch]))
    except (NeedleError, mujoco.FatalError) as failed:
        if len(batch) == 1:
            return [failed if isinstance(failed, NeedleError) else SimulationFailed(str(failed))]
    half = len(batch) // 2
    return _simulated(batch[:half]) + _simulated(batch[half:])
