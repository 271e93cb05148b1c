"""One step of a small rig, to test the parts of the integrator on."""

from types import SimpleNamespace

import numpy as np
import pytest

from validation.rig.laws.parameters import LawParameters
from validation.rig.mesh import MeshSize, assemble, empty_chain
from validation.rig.state import StepInput, initial_state, workspace

LAW = LawParameters(323.6, 0.018, 0.295)


@pytest.fixture
def step():
    """Makes the arguments of a step: law, mesh, chain, state, inputs and work."""

    def make(*, lagrangian=False, sheath=0, cells=6, base=0.0, lead=100.0, time=0.0, **law):
        nodes = cells + 1 if lagrangian else sheath + cells + 2
        law, mesh = LAW._replace(**law), MeshSize(nodes, sheath, lagrangian)
        chain = empty_chain(nodes)
        assemble(chain, law, mesh, 40.0, 40.0, 60.0)
        work = workspace(nodes)
        work.angle[:] = np.linspace(0.3, 0.1, nodes) if base else 0.0
        inputs = StepInput(base, 0.0, lead, 0.0, time, 0.0)
        state = initial_state(nodes, 4 * nodes if lagrangian else nodes, 0.0)
        return SimpleNamespace(law=law, mesh=mesh, chain=chain, state=state, inputs=inputs, work=work)

    return make
