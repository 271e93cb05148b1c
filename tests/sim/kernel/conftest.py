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
from sim.needles.numeric_fields import header
from sim.spec import needle_spec


@pytest.fixture(scope="session")
def interpreted():
    """Modules of `sim.kernel`, but the callback, from the same source with numba switched off."""
    compiled = {name: module for name, module in sys.modules.items() if name.startswith("sim.kernel")}
    for name in compiled:
        del sys.modules[name]
    numba.config.DISABLE_JIT = True
    try:
        package = importlib.import_module("sim.kernel")
        found = [m.name for m in pkgutil.walk_packages(package.__path__, "sim.kernel.") if not m.ispkg]
        names = [name for name in found if not name.endswith(".callback")]
        return SimpleNamespace(**{n.rpartition(".")[2]: importlib.import_module(n) for n in names})
    finally:
        numba.config.DISABLE_JIT = False
        for name in [name for name in sys.modules if name.startswith("sim.kernel")]:
            del sys.modules[name]
        sys.modules.update(compiled)
        sim.kernel = compiled["sim.kernel"]


@pytest.fixture(scope="session")
def arrays_of(interpreted):
    """`ModelArrays` of a compiled model."""

    def read(model):
        return interpreted.shaft.ModelArrays(
            model.body_inertia,
            model.body_iquat,
            model.body_subtreemass[1],
            model.jnt_stiffness,
            model.actuator_gear,
            model.actuator_gainprm,
            model.actuator_forcelimited,
            model.actuator_forcerange,
        )

    return read


@pytest.fixture(scope="session")
def shaft_of(interpreted, arrays_of):
    """`Shaft` of a set-up, as `sim.kernel.shaft` reads it from the compiled model."""

    def read(setup):
        shaft, model = interpreted.shaft, needle_spec(setup).compile()
        chain = bool(model.numeric("needle").data[interpreted.memory_map.H_CHAIN])
        siblings = None if chain else model.numeric("needle_springs").data
        needle = arrays_of(model)
        inertia, spring = np.zeros(setup.nodes_mm.size), np.zeros(setup.nodes_mm.size - 1)
        shaft.read_nodes(needle.body_inertia, needle.body_iquat, inertia)
        shaft.read_springs(chain, needle.jnt_stiffness, siblings, spring)
        places = interpreted.memory_map
        return shaft.Shaft(
            inertia,
            spring,
            needle.jnt_stiffness[places.FIRST_JOINT],
            shaft.motor_of(needle, places.U_DRIVE, 0),
            shaft.motor_of(needle, places.U_TIP, places.ABOUT_X),
            needle.mass,
            needle.jnt_stiffness[0],
            shaft.motor_of(needle, places.U_CARRIAGE, 0),
        )

    return read


@pytest.fixture(scope="session")
def at_stage(interpreted, shaft_of):
    """The first stage of a step of a set-up, prepared in the interpreter: law, workspace, frame."""

    def prepared(setup, *, turn_deg=10.0, speed_m_s=0.0, seed=0, end=0.0):
        places = interpreted.memory_map
        law = law_table(setup.needle, setup.drive, setup.tissue, rows=setup.rows)
        head, mesh = header(setup, rows=len(law)), setup.nodes_mm * units.MM
        n, rows = mesh.size - 1, len(law)
        state = np.zeros((rows, n, 2, places.SITE))
        memory = np.zeros(places.scratch(n, rows))
        w = interpreted.workspace.divide(memory, n, rows, state.copy())
        # angles that fall towards the tip, and unequal rates
        theta = np.radians(turn_deg) * np.linspace(1.0, 0.4, n + 1)
        rates = np.random.default_rng(seed).normal(0.0, 0.3, n + 1)
        shaft = shaft_of(setup)
        lengths = (setup.free_mm * units.MM, setup.inserted_mm * units.MM)
        inputs = interpreted.inputs.Inputs(*lengths, speed_m_s, 1.0, 0.0, 0.0, 0.0, 0.0, False)
        g = interpreted.method.GAMMAS[1] * setup.discretisation.step_s
        frame = interpreted.workspace.frame_of(head, shaft, g, inputs, end)
        nonlinear = interpreted.beginning.begin(
            head, mesh, law, shaft, theta, rates, state, w, frame, inputs
        )
        return SimpleNamespace(law=law, w=w, frame=frame, head=head, shaft=shaft, nonlinear=nonlinear)

    return prepared
