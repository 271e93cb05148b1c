"""Running a protocol: simulate, check the time step if the protocol bounds its error, record."""

import math
from typing import Any

import mujoco
import numpy as np

from models.errors import InvalidValue
from sim.needles.run import Run
from sim.protocol import Protocol
from sim.recording.recording import Recording, record
from sim.simulation import simulate


def perform(protocol: Protocol, model: mujoco.MjModel | None = None) -> Recording:
    """Simulate a protocol and record everything.

    Args:
      model: the protocol's model with changed numbers (`sim.model_file`); None: as the protocol says.

    Raises:
      InvalidValue: the time step causes a larger error than the protocol allows.
      SimulationFailed: see `sim.simulation.simulate`.
    """
    models = None if model is None else [model]
    run = simulate([protocol.setup()], protocol.schedule(), models=models, keep_shape=True)[0]
    parameters: dict[str, Any] = {"protocol": protocol.name, "description": protocol.description}
    if protocol.accuracy_deg is not None and model is None:
        parameters["tip_error_deg"] = checked_error_deg(protocol, run)
    return record(run, parameters)


def step_error_deg(protocol: Protocol, run: Run) -> float:
    """Largest error of the tip due to the time step, deg, from a run with half of it (Richardson)."""
    fine = protocol.discretisation.but(step_s=run.setup.discretisation.step_s / 2)
    halved = simulate([protocol.but(discretisation=fine).setup()], protocol.schedule())[0]
    size = min(run.tip_deg.size, (halved.tip_deg.size + 1) // 2)
    difference = np.abs(run.tip_deg[:size] - halved.tip_deg[: 2 * size : 2]).max()
    return float(difference / (1.0 - 0.5**protocol.discretisation.order))


def checked_error_deg(protocol: Protocol, run: Run) -> float:
    """The error of the tip due to the time step, deg, if the protocol allows it.

    Raises:
      InvalidValue: the error is larger; the message names a step that is small enough.
    """
    error, step = step_error_deg(protocol, run), protocol.discretisation.step_s
    allowed = protocol.accuracy_deg or np.inf
    if error > allowed:
        # Halves of the step keep the corners of the motion at the ends of steps.
        enough = step / 2 ** math.ceil(math.log2(error / allowed) / protocol.discretisation.order)
        raise InvalidValue(
            "discretisation.step_s",
            step,
            f"a step that keeps the tip within {allowed:g} deg (this one: {error:.3g} deg)",
            f"try {enough:g} s",
        )
    return error
