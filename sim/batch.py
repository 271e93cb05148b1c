"""Many insertions in one call: other tissues, needles and motions side by side, one thread per core.

Insertions of one model size and one number of steps share MuJoCo's batches. A thread that steps a batch
holds no lock of Python, so that others make their models meanwhile. Results do not depend on who runs
beside whom.
"""

import os
import typing
from collections import defaultdict
from collections.abc import Hashable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import mujoco

from models.errors import NeedleError
from sim.schedule import Schedule
from sim.simulation import Run, SimulationFailed, prepare_processes, simulate
from sim.spec import Setup

_SIDE_BY_SIDE = 8  # needles of one batch: few enough to share out evenly, many enough to pay


class Insertion(typing.Protocol):
    """What can be simulated: a protocol, or anything else that knows its set-up and its inputs."""

    def setup(self) -> Setup:
        """The needle."""
        ...

    def schedule(self) -> Schedule:
        """What is done to it."""
        ...


@dataclass(frozen=True, kw_only=True)
class _Ready:
    """An insertion as its model and inputs, and its place in the call."""

    place: int
    setup: Setup
    inputs: Schedule

    @property
    def size(self) -> Hashable:
        """What insertions of one batch share."""
        discretisation, kind = self.setup.discretisation, self.setup.drive.kind
        nodes, rows = self.setup.nodes_mm.size, len(self.setup.law)
        return discretisation, kind, nodes, rows, self.inputs.at_steps(discretisation.step_s).time_s.size


def simulate_each(
    insertions: Sequence[Insertion], *, threads: int | None = None
) -> list[Run | NeedleError]:
    """Simulate insertions, as protocols are, that may differ in everything, each as if it were alone.

    Args:
      threads: None: one for each core. Results do not depend on it, to the last bit.

    Returns:
      In their order, a run, or why there is none: `SimulationFailed`, or `InvalidValue` for one that
      makes no model.
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
    """Insertions of one size, a batch as soon as it is full; those that make no set-up are `found`."""
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
    """Results of a batch with their places."""
    return [(one.place, result) for one, result in zip(batch, _simulated(batch), strict=True)]


def _simulated(batch: Sequence[_Ready]) -> list[Run | NeedleError]:
    """Runs of a batch; where one fails, halves are tried until it is alone with its error."""
    try:
        return list(simulate([one.setup for one in batch], [one.inputs for one in batch]))
    except (NeedleError, mujoco.FatalError) as failed:
        if len(batch) == 1:
            return [failed if isinstance(failed, NeedleError) else SimulationFailed(str(failed))]
    half = len(batch) // 2
    return _simulated(batch[:half]) + _simulated(batch[half:])
