"""The time that the tissue callback adds to a bare `mj_step`, and the time of each stage of the step.

The states of the fast turn (20 cm needle, 90 deg in 0.3 s, steps of 10 ms) are
recorded over its first second. A compiled loop then restores each of them with
`mj_setState` and takes one `mj_step`: with the model as it is, and with its header
unmarked, so that the callback returns at once. The time of restoring is measured
separately and subtracted. So both step the same states: a needle without tissue,
left to itself, would soon be timed on zeros and denormals. Both use one model and one
data: another place in memory alone changes a step by several percent. The difference
holds the passive and the sensor callback; the passive one is also called alone.
"""

import ctypes
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import mujoco
import numpy as np
from numba import njit
from numpy.typing import NDArray

from benchmarks import report
from sim.discretisation import Arrangement
from sim.kernel import memory_map
from sim.kernel.native.callback import install
from sim.needles.inputs import controls, initial_data
from sim.needles.kept import compile_model
from sim.needles.setup import Setup
from studies.crosscheck.motion import fast_turn, viscous_setup

Array = NDArray[np.float64]
Sweep = Callable[[int, int, Array], None]

ELEMENTS = (16, 32, 64)
SHARE_BOUNDS = {Arrangement.CHAIN: 10.0, Arrangement.SIBLINGS: 25.0}  # percent, at 64 elements
_STEPS = 100
_SWEEPS = 2  # of all states, in one timing
_TURNS = 120
_STATE = int(mujoco.mjtState.mjSTATE_INTEGRATION)
_TIMERS = tuple(
    int(getattr(mujoco.mjtTimer, f"mjTIMER_{name}"))
    for name in ("STEP", "POS_KINEMATICS", "POS_INERTIA", "POSITION", "VELOCITY", "ADVANCE")
)
_STAGES = ("kinematics", "inertia", "other position", "velocity", "advance", "solution, sensors")


@dataclass(frozen=True, kw_only=True)
class Cost:
    """Times of one `mj_step`, us.

    Attributes:
      callback_us: what the callbacks add.
      alone_us: the passive callback called by itself.
      stages_us: MuJoCo's own timers over the step with callback, by stage.
    """

    arrangement: Arrangement
    elements: int
    bare_us: float
    callback_us: float
    alone_us: float
    stages_us: dict[str, float]

    @property
    def share(self) -> float:
        """What the callbacks add, over the bare step, percent."""
        return 100 * self.callback_us / self.bare_us


def _library() -> ctypes.CDLL:
    found = sorted(Path(mujoco.__file__).parent.glob("libmujoco*"))
    library = ctypes.CDLL(str(found[0]))
    library.mj_step.argtypes = (ctypes.c_ssize_t,) * 2
    library.mj_setState.argtypes = (*(ctypes.c_ssize_t,) * 3, ctypes.c_int)
    library.mj_step.restype = library.mj_setState.restype = None
    return library


def _compile_sweeps() -> dict[str, Sweep]:
    """Loops over states: restore each, and then step, call the callback, or nothing."""
    library = _library()
    restore, step, passive = library.mj_setState, library.mj_step, install()[0].ctypes
    width = np.dtype(np.float64).itemsize

    @njit
    def restored(model: int, data: int, states: Array) -> None:
        for k in range(states.shape[0]):
            restore(model, data, states.ctypes.data + k * states.shape[1] * width, _STATE)

    @njit
    def stepped(model: int, data: int, states: Array) -> None:
        for k in range(states.shape[0]):
            restore(model, data, states.ctypes.data + k * states.shape[1] * width, _STATE)
            step(model, data)

    @njit
    def called(model: int, data: int, states: Array) -> None:
        for k in range(states.shape[0]):
            restore(model, data, states.ctypes.data + k * states.shape[1] * width, _STATE)
            passive(model, data)

    return {"restored": restored, "stepped": stepped, "called": called}


def record_states(setup: Setup) -> tuple[mujoco.MjModel, Array]:
    """The model, and the states of the fast turn before each step, (steps, state)."""
    model = compile_model(setup)
    inputs = controls(fast_turn().at_steps(setup.discretisation.step_s), setup)
    data = initial_data(model, setup, inputs[0])
    states = np.empty((_STEPS, mujoco.mj_stateSize(model, _STATE)))
    for k in range(_STEPS):
        data.ctrl[:] = inputs[k + 1]
        mujoco.mj_getState(model, data, states[k], _STATE)
        mujoco.mj_step(model, data)
    return model, states


def _stages_us(task: Callable[[], None], model: mujoco.MjModel, data: mujoco.MjData) -> dict[str, float]:
    """MuJoCo's timers over the task, from its quickest turn, us a step."""
    turns = []
    for _ in range(_TURNS):
        mujoco.mj_resetData(model, data)
        task()
        turns.append([data.timer[kind].duration / data.timer[0].number for kind in _TIMERS])
    step, kinematics, inertia, position, velocity, advance = 1e6 * np.array(min(turns))
    parts = (kinematics, inertia, position - kinematics - inertia, velocity, advance)
    return dict(zip(_STAGES, (*parts, step - position - velocity - advance), strict=True))


def measure_one(setup: Setup, sweeps: dict[str, Sweep]) -> Cost:
    """Bare and whole step of one model."""
    model, states = record_states(setup)
    data = mujoco.MjData(model)
    header = model.numeric("needle").data

    def repeated(sweep: Sweep, *, marked: bool = True) -> Callable[[], None]:
        def run() -> None:
            header[memory_map.H_MAGIC] = memory_map.MAGIC if marked else 0.0
            for _ in range(_SWEEPS):
                sweep(model._address, data._address, states)

        return run

    tasks = {
        "restored": repeated(sweeps["restored"]),
        "bare": repeated(sweeps["stepped"], marked=False),
        "whole": repeated(sweeps["stepped"]),
        "called": repeated(sweeps["called"]),
    }
    least = report.least_times_s(tasks, turns=_TURNS, enough_s=2.0)
    tasks["bare"]()
    _check(data)
    us = {name: 1e6 * seconds / (_SWEEPS * _STEPS) for name, seconds in least.items()}
    return Cost(
        arrangement=setup.discretisation.arrangement,
        elements=setup.discretisation.elements,
        bare_us=us["bare"] - us["restored"],
        callback_us=us["whole"] - us["bare"],
        alone_us=us["called"] - us["restored"],
        stages_us=_stages_us(tasks["whole"], model, data),
    )


def _check(data: mujoco.MjData) -> None:
    """Check that the bare step had rates to integrate."""
    if not np.isfinite(data.qpos).all() or np.abs(data.qvel).max() < 1e-9:
        raise RuntimeError(f"the bare step ended at rates {data.qvel}: not a step worth timing")


def measure() -> list[Cost]:
    """Every arrangement and number of elements."""
    sweeps = _compile_sweeps()
    return [
        measure_one(viscous_setup(elements=n, arrangement=arrangement), sweeps)
        for arrangement in Arrangement
        for n in ELEMENTS
    ]


def _draw(costs: list[Cost], folder: Path) -> None:
    figure, axis = plt.subplots(figsize=(9, 5), layout="constrained")
    labels = [f"{c.arrangement}\nn = {c.elements}" for c in costs]
    base = np.zeros(len(costs))
    for stage in _STAGES:
        height = np.array([c.stages_us[stage] for c in costs])
        height -= np.array([c.callback_us if stage == "velocity" else 0.0 for c in costs])
        axis.bar(labels, height, bottom=base, label=stage)
        base += height
    axis.bar(labels, [c.callback_us for c in costs], bottom=base, color="k", label="tissue callback")
    axis.set(ylabel="us a step", title="Where an mj_step goes")
    axis.legend()
    report.save(figure, folder, "callback")


def run(folder: Path) -> list[report.Goal]:
    """Measure, print, write."""
    costs = measure()
    rows: list[dict[str, Any]] = [
        {
            "arrangement": str(c.arrangement),
            "n": c.elements,
            "bare step, us": c.bare_us,
            "callback adds, us": c.callback_us,
            "callback alone, us": c.alone_us,
            "adds over bare, %": c.share,
        }
        for c in costs
    ]
    report.show("The tissue callback beside a bare mj_step", rows, folder, "callback")
    rows = [
        {"arrangement": str(c.arrangement), "n": c.elements}
        | {f"{stage}, us": us for stage, us in c.stages_us.items()}
        for c in costs
    ]
    title = "Where the step goes, by MuJoCo's own timers (velocity holds the passive callback)"
    report.show(title, rows, folder, "callback_stages")
    _draw(costs, folder)
    return [
        report.Goal(
            name=f"callback over bare mj_step, {c.arrangement}, n = {c.elements}",
            measured=c.share,
            bound=SHARE_BOUNDS[c.arrangement],
            unit="%",
            accuracy="the same states",
        )
        for c in costs
        if c.elements == ELEMENTS[-1]
    ]


if __name__ == "__main__":
    folder_ = report.out_folder(report.parser(__doc__))
    report.show_goals(run(folder_), folder_)
