"""Every method of the work-precision comparison, at every setting that it is tried at."""

from collections.abc import Callable
from functools import partial
from itertools import product

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from benchmarks.compiled_loop import BACKWARD_EULER, MIDPOINT, by_theta_method, kernel_loop
from benchmarks.rivals import by_modes, by_odeint, by_solve_ivp, equations
from benchmarks.tissues import LENGTH_MM, SMOOTH, TURN_S, Case
from models.needle import NITINOL
from sim.discretisation import Arrangement, Discretisation, Mesh
from sim.kernel import memory_map
from sim.needles.inputs import controls, initial_data
from sim.needles.kept import compile_model
from sim.needles.setup import Setup
from studies.crosscheck.motion import fast_turn

Array = NDArray[np.float64]
Answer = tuple[Array, Array]

CHAIN, SIBLINGS, KERNEL = "MuJoCo, chain", "MuJoCo, siblings", "our kernel alone"
ODEINT, LSODA = "LSODA, odeint", "LSODA, solve_ivp"
LSODA_NUMPY, BDF, RADAU = "LSODA, law in NumPy", "BDF, solve_ivp", "Radau, solve_ivp"
MODES, EULER, TRAPEZE = "modes", "backward Euler loop", "midpoint loop"
OURS = (CHAIN, SIBLINGS)

_ELEMENTS = (4, 6, 8, 12, 16)
_ORDERS = (2, 3)
_STEPS_S = tuple(TURN_S / k for k in (3, 4, 5, 6, 7, 8, 10, 12, 15, 20, 24, 30, 40, 60))
_CELLS = (24, 32, 48, 64)
_TOLERANCES = tuple(10.0**-k for k in (1.5, 2, 2.5, 3, 3.5, 4, 4.5))
_LOOP_STEPS_S = (0.05, 0.03, 0.02, 0.01, 0.005, 0.002, 0.001, 5e-4, 2e-4)
_MODES = (4, 6, 8, 12, 16, 24, 32)
_STATE = int(mujoco.mjtState.mjSTATE_INTEGRATION)

Settings = dict[tuple[str, str], Callable[[], Answer]]


def setup_of(case: Case, **discretisation: object) -> Setup:
    """The simulator's needle in a tissue."""
    return Setup(
        needle=NITINOL,
        tissue=case.tissue,
        discretisation=Discretisation(**discretisation),
        mesh=Mesh.EULERIAN,
        free_mm=0.0,
        inserted_mm=LENGTH_MM,
    )


def rollout_of(setup: Setup) -> Callable[[], Answer]:
    """A run of the simulator, compiled and ready to go."""
    model = compile_model(setup)
    stepped = fast_turn().at_steps(setup.discretisation.step_s)
    ctrl = controls(stepped, setup)
    data = initial_data(model, setup, ctrl[0])
    start = np.empty(mujoco.mj_stateSize(model, _STATE))
    mujoco.mj_getState(model, data, start, _STATE)
    batch = Batch(model, 1, 1)

    def run() -> Answer:
        batch.state[0] = start
        outputs = batch.rollout(len(ctrl) - 1, ctrl[None, 1:], record=["sensordata"])["sensordata"][0]
        return stepped.time_s[1:], np.degrees(outputs[:, memory_map.O_TIP_ANGLE])

    return run


def _kernel_of(setup: Setup, loop: Callable[..., Array]) -> Callable[[], Answer]:
    model = compile_model(setup)
    stepped = fast_turn().at_steps(setup.discretisation.step_s)
    ctrl, data = controls(stepped, setup), mujoco.MjData(model)
    return lambda: (stepped.time_s, np.degrees(loop(model, data, ctrl)))


def our_settings(case: Case) -> Settings:
    """The simulator in both arrangements, and its kernel without MuJoCo."""
    loop, settings = kernel_loop(), Settings()
    for n, h, order in product(_ELEMENTS, _STEPS_S, _ORDERS):
        name = f"n = {n}, {1e3 * h:.3g} ms, order {order}"
        for method, arrangement in zip(OURS, Arrangement, strict=True):
            setup = setup_of(case, elements=n, step_s=h, order=order, arrangement=arrangement)
            settings[method, name] = rollout_of(setup)
        settings[KERNEL, name] = _kernel_of(setup, loop)
    return settings


def scipy_settings(case: Case) -> Settings:
    """Scipy's stiff solvers at every tolerance, number of cells, and restart or none."""
    settings = Settings()
    for cells in _CELLS:
        system = equations(case, cells)
        plain = equations(case, cells, compiled=False)
        for tolerance in _TOLERANCES:
            name = f"n = {cells}, rtol {tolerance:.0e}"
            settings[ODEINT, name] = partial(by_odeint, system, tolerance)
            for restart in (False, True):
                full = name + (", restarted" if restart else "")
                for label in (LSODA, BDF, RADAU, LSODA_NUMPY):
                    law = plain if label == LSODA_NUMPY else system
                    method = label.split(",")[0]
                    settings[label, full] = partial(
                        by_solve_ivp, law, method, tolerance, restart=restart
                    )
    return settings


def loop_settings(case: Case) -> Settings:
    """Compiled loops of a plain method and, in viscous tissue, modes."""
    settings = Settings()
    for cells in _CELLS:
        for h in _LOOP_STEPS_S:
            for method, implicit in ((EULER, BACKWARD_EULER), (TRAPEZE, MIDPOINT)):
                name = f"n = {cells}, {1e3 * h:.3g} ms"
                settings[method, name] = partial(by_theta_method, case, cells, h, implicit)
    if case is SMOOTH:
        settings |= {(MODES, f"{count} modes"): partial(by_modes, count) for count in _MODES}
    return settings


def all_settings(case: Case) -> Settings:
    """All of them, by method and setting."""
    return our_settings(case) | scipy_settings(case) | loop_settings(case)
