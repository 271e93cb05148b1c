"""Models and batches of MuJoCo that are kept: making them costs as much as seconds of simulation.

A fit simulates a handful of needles thousands of times, with other numbers each time. Set-ups of the
same bodies (`Setup.bodies`) take turns on the same models, whose numbers are written anew; needles of
the same size take turns on the same batch.
"""

from collections.abc import Sequence

import mujoco
from mujoco.batch import Batch

from sim.kernel.callback import install
from sim.spec import Setup, needle_spec, set_numbers

_MOST_MODELS = 64
_MOST_BATCHES = 64

_MODELS: dict[tuple[object, ...], list[mujoco.MjModel]] = {}
_BATCHES: dict[tuple[int, ...], Batch] = {}


def compile_model(setup: Setup) -> mujoco.MjModel:
    """The compiled model, with the tissue callback installed."""
    install()
    return needle_spec(setup).compile()


def models_of(setups: Sequence[Setup]) -> list[mujoco.MjModel]:
    """A model for each set-up, good until the next call."""
    taken: dict[tuple[object, ...], int] = {}
    found = []
    for setup in setups:
        key = setup.bodies
        if key is None:
            found.append(compile_model(setup))
            continue
        place = taken.get(key, 0)
        taken[key] = place + 1
        found.append(_kept_model(key, place, setup))
    return found


def _kept_model(key: tuple[object, ...], place: int, setup: Setup) -> mujoco.MjModel:
    """The model at a place of those of the same bodies, with the numbers of a set-up."""
    if key not in _MODELS and len(_MODELS) >= _MOST_MODELS:
        _MODELS.pop(next(iter(_MODELS)))  # the oldest
    models = _MODELS.setdefault(key, [])
    if place == len(models):
        models.append(compile_model(setup))
    else:
        set_numbers(models[place], setup)
    return models[place]


def batch_of(models: Sequence[mujoco.MjModel], threads: int) -> Batch:
    """A batch that runs these models of one size, good until the next call.

    Threads of MuJoCo do not survive a fork of the process: a batch that has some is not kept.
    """
    first = models[0]
    if threads != 1:
        batch = Batch(first, len(models), threads)
    else:
        size = (len(models), first.nq, first.nuserdata, first.nnumericdata)
        if size not in _BATCHES and len(_BATCHES) >= _MOST_BATCHES:
            _BATCHES.pop(next(iter(_BATCHES)))
        batch = _BATCHES.get(size) or _BATCHES.setdefault(size, Batch(first, len(models), 1))
    batch.set_models(models)
    return batch
