"""The kernel as plain Python, for tests that would otherwise compile it function by function."""

import importlib
import pkgutil
import sys
from types import SimpleNamespace

import numba
import numpy as np
import pytest

import sim
import sim.kernel
from models import units
from sim.law_table import law_table
from sim.spec import header


@pytest.fixture(scope="session")
def interpreted():
    """Modules of `sim.kernel`, but the callback, from the same source with numba switched off."""
    compiled = {name: module for name, module in sys.modules.items() if name.startswith("sim.kernel")}
    for name in compiled:
        del sys.modules[name]
    numba.config.DISABLE_JIT = True
    try:
        package = importlib.import_module("sim.kernel")
        names = [m.name for m in pkgutil.iter_modules(package.__path__) if m.name != "callback"]
        return SimpleNamespace(**{n: importlib.import_module(f"sim.kernel.{n}") for n in names})
    finally:
        numba.config.DISABLE_JIT = False
        for name in [name for name in sys.modules if name.startswith("sim.kernel")]:
            del sys.modules[name]
        sys.modules.update(compiled)
        sim.kernel = compiled["sim.kernel"]


@pytest.fixture(scope="session")
def at_stage(interpreted):
    """The first stage of a step of a set-up, prepared in the interpreter: law, workspace, frame."""

    def prepared(setup, *, turn_deg=10.0, speed_m_s=0.0, seed=0):
        places, step = interpreted.memory_map, interpreted.step
        law = law_table(setup.needle, setup.drive, setup.tissue, rows=setup.rows)
        head, mesh = header(setup, rows=len(law)), setup.nodes_mm * units.MM
        n, rows = mesh.size - 1, len(law)
        state = np.zeros((rows, n, 2, places.SITE))
        memory = np.zeros(places.scratch(n, rows))
        w = interpreted.workspace.divide(memory, n, rows, state.copy())
        now = np.zeros(places.block(n, rows))
        # angles that fall towards the tip, and unequal rates
        theta = np.radians(turn_deg) * np.linspace(1.0, 0.4, n + 1)
        now[places.B_ANGLES + n + 1 : places.B_ANGLES + 2 * (n + 1)] = np.random.default_rng(
            seed
        ).normal(0.0, 0.3, n + 1)
        frame = interpreted.workspace.Frame(
            step.GAMMA * setup.discretisation.step_s,
            speed_m_s / head[places.H_RADIUS],
            head[places.H_ADVECTION] * speed_m_s,
            head[places.H_PRESLIDING],
            head[places.H_SERVO],
            head[places.H_BACKLASH],
            head[places.H_DRIVE] == places.DRIVE_ANGLE,
        )
        lengths = (setup.free_mm * units.MM, setup.inserted_mm * units.MM)
        step._prepare(head, mesh, law, theta, now, state, w, frame, *lengths, False)
        return SimpleNamespace(law=law, w=w, frame=frame, head=head)

    return prepared
