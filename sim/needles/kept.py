"""Models, batches and data of MuJoCo that are kept: making them costs as much as seconds of simulation.

A fit simulates a handful of needles thousands of times, with other numbers each time. Set-ups of the
same bodies (`Setup.bodies`) use the same models one after the other, whose numbers are written anew;
needles of the same size the same batches. What is in use is taken out: threads do not share it.
"""

from collections.abc import Callable, Hashable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from typing import Generic, TypeVar

import mujoco
from mujoco.batch import Batch

from sim.kernel.callback import install
from sim.spec import Setup, needle_spec, set_numbers

T = TypeVar("T")


class Kept(Generic[T]):
    """Things that are made once and used again, by what they may be used for."""

    def __init__(self, most: int = 64) -> None:
        """Of at most so many kinds; the oldest kind makes room."""
        self._most = most
        self._free: dict[Hashable, list[T]] = {}

    @contextmanager
    def taken(self, kind: Hashable, make: Callable[[], T]) -> Iterator[tuple[T, bool]]:
        """One of a kind, and whether it was made just now."""
        free = self._free.setdefault(kind, [])
        try:
            one, new = free.pop(), False
        except IndexError:
            one, new = make(), True
        yield one, new
        free.append(one)
        for oldest in list(self._free)[: -self._most]:
            self._free.pop(oldest, None)


_MODELS: Kept[mujoco.MjModel] = Kept()
_BATCHES: Kept[Batch] = Kept()
_DATA: Kept[mujoco.MjData] = Kept()


def compile_model(setup: Setup) -> mujoco.MjModel:
    """The compiled model, with the tissue callback installed."""
    install()
    return needle_spec(setup).compile()


@contextmanager
def models_of(setups: Sequence[Setup]) -> Iterator[list[mujoco.MjModel]]:
    """A model for each set-up, to be used inside of the `with` alone."""
    with ExitStack() as stack:
        yield [stack.enter_context(_model_of(setup)) for setup in setups]


@contextmanager
def _model_of(setup: Setup) -> Iterator[mujoco.MjModel]:
    bodies = setup.bodies
    if bodies is None:
        yield compile_model(setup)
        return
    with _MODELS.taken(bodies, lambda: compile_model(setup)) as (model, new):
        if not new:
            set_numbers(model, setup)
        yield model


@contextmanager
def batch_of(models: Sequence[mujoco.MjModel], threads: int) -> Iterator[Batch]:
    """A batch that runs these models of one size.

    Threads of MuJoCo do not survive a fork of the process: a batch that has some is not kept.
    """
    first = models[0]
    if threads != 1:
        batch = Batch(first, len(models), threads)
        batch.set_models(models)
        yield batch
        return
    size = (len(models), *_size(first))
    with _BATCHES.taken(size, lambda: Batch(first, len(models), 1)) as (batch, _):
        batch.set_models(models)
        yield batch


@contextmanager
def data_of(model: mujoco.MjModel) -> Iterator[mujoco.MjData]:
    """Data of a model, as they are at the start."""
    with _DATA.taken(_size(model), lambda: mujoco.MjData(model)) as (data, _):
        mujoco.mj_resetData(model, data)
        yield data


def _size(model: mujoco.MjModel) -> tuple[int, ...]:
    return model.nq, model.nuserdata, model.nnumericdata
