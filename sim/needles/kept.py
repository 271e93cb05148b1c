"""Models, batches and data of MuJoCo, kept for reuse: making one costs as much as simulating seconds.

A fit simulates a few needles thousands of times, with other numbers each time. Set-ups of the same
size (`Setup.size`) reuse the same models, in which new numbers are written; their needles
reuse the same batches. An object in use is not available to other threads.
"""

from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from typing import Generic, TypeVar

import mujoco
from mujoco.batch import Batch

from sim.kernel.native.callback import install
from sim.needles.setup import Setup
from sim.spec import needle_spec, set_bodies, set_numbers

T = TypeVar("T")


class Kept(Generic[T]):
    """A cache of objects by key, each of which one thread uses at a time."""

    def __init__(self, most: int = 64) -> None:
        """`most`: number of keys; the oldest key is dropped for a new one."""
        self._most = most
        self._free: dict[Hashable, list[T]] = {}

    @contextmanager
    def taken(self, kind: Hashable, make: Callable[[], T]) -> Iterator[tuple[T, bool]]:
        """An object for a key, and whether it was made just now."""
        free = self._free.setdefault(kind, [])
        try:
            one, new = free.pop(), False
        except IndexError:
            one, new = make(), True
        yield one, new
        free.append(one)
        for oldest in list(self._free)[: -self._most]:
            self._free.pop(oldest, None)


@dataclass
class _Compiled:
    """A compiled model, and the set-up whose numbers it has."""

    model: mujoco.MjModel
    setup: Setup

    def become(self, setup: Setup) -> None:
        """Write the numbers of another set-up of the same size."""
        other_bodies = not setup.has_bodies_of(self.setup)
        set_numbers(self.model, setup)
        if other_bodies:
            set_bodies(self.model, setup)
        if other_bodies or setup.servo_n_m_per_rad != self.setup.servo_n_m_per_rad:
            with data_of(self.model) as data:
                mujoco.mj_setConst(self.model, data)
        self.setup = setup


_MODELS: Kept[_Compiled] = Kept()
_BATCHES: Kept[Batch] = Kept()
_DATA: Kept[mujoco.MjData] = Kept()


def compile_model(setup: Setup) -> mujoco.MjModel:
    """The compiled model, with the tissue callback installed."""
    install()
    return needle_spec(setup).compile()


@contextmanager
def models_of(setups: Sequence[Setup]) -> Iterator[list[mujoco.MjModel]]:
    """A model for each set-up; use them only inside the `with` block."""
    with ExitStack() as stack:
        yield [stack.enter_context(_model_of(setup)) for setup in setups]


def models_in_turn(setups: Iterable[Setup]) -> Iterator[mujoco.MjModel]:
    """A model for each set-up, one after the other; use each before the next.

    Set-ups of one size get the same model, whose bodies are written only where they differ.
    """
    for setup in setups:
        with _model_of(setup) as model:
            yield model


@contextmanager
def _model_of(setup: Setup) -> Iterator[mujoco.MjModel]:
    with _MODELS.taken(setup.size, lambda: _Compiled(compile_model(setup), setup)) as (one, new):
        if not new:
            one.become(setup)
        yield one.model


@contextmanager
def batch_of(models: Sequence[mujoco.MjModel], threads: int) -> Iterator[Batch]:
    """A batch that runs these models of one size.

    MuJoCo's threads do not survive a fork of the process: a batch that has threads is not kept.
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
    """Data of a model in its initial state."""
    with _DATA.taken(_size(model), lambda: mujoco.MjData(model)) as (data, _):
        mujoco.mj_resetData(model, data)
        yield data


def _size(model: mujoco.MjModel) -> tuple[int, ...]:
    return model.nq, model.nuserdata, model.nnumericdata
