"""A protocol run in closed loop: its base angle becomes the reference of the tip."""

from collections.abc import Callable

from models.errors import InvalidValue
from sim.closed_loop import run_closed_loop
from sim.protocol import Protocol
from sim.recording.recording import Recording
from studies.control.closed_loop_recording import record_closed_loop
from studies.control.step_response import DAMPING
from studies.control.tip_controllers import ControllerDesign, tip_controller_named

_LOOP_STEP_S = 0.002  # a controller acts at every step


def perform_closed_loop(
    protocol: Protocol, controller: str, progress: Callable[[float], None] = lambda share: None
) -> Recording:
    """Run a protocol in closed loop with a tip controller, given by name.

    The estimator assumes viscous tissue with the damping of the first layer, or the paper's
    if that layer has none.

    Args:
      progress: called from time to time with the share that is done.

    Raises:
      InvalidValue: the protocol drives the base by torque.
      UnknownName: no such controller.
    """
    if protocol.drive.kind.value != "angle":
        kind = protocol.drive.kind.value
        raise InvalidValue("drive.kind", kind, "'angle', because a tip controller sets the base angle")
    damping = protocol.tissue.layers[0].interface.viscous_n_mm_s_per_mm or DAMPING
    design = ControllerDesign(needle=protocol.needle, damping_n_mm_s_per_mm=damping)
    tip_controller = tip_controller_named(controller, design)
    step = min(_LOOP_STEP_S, protocol.discretisation.step_s)
    fine = protocol.but(discretisation=protocol.discretisation.but(step_s=step))
    controlled = run_closed_loop(
        fine.setup(),
        fine.schedule(),
        tip_controller,
        log=tip_controller.signals,
        keep_shape=True,
        progress=progress,
    )
    about = {
        "protocol": protocol.name,
        "description": f"{protocol.description}; tip controlled by {controller}",
        "controller": controller,
    }
    return record_closed_loop(controlled, about)
