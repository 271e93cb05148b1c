"""A protocol flown by a controller: its base angle becomes the wanted tip angle."""

from models.errors import InvalidValue
from sim.closed_loop import fly
from sim.control.pilots import Design, pilot_named
from sim.control.recording import record_flight
from sim.control.tables import DAMPING
from sim.protocol import Protocol
from sim.recording import Recording

_LOOP_STEP_S = 0.002  # a controller acts at every step


def perform_flown(protocol: Protocol, controller: str) -> Recording:
    """Fly a protocol by the name of a controller.

    The estimator takes the tissue for viscous, with the first layer's damping (or the
    paper's, where that layer has none).

    Raises:
      InvalidValue: the protocol drives the base by torque.
      UnknownName: no such controller.
    """
    if protocol.drive.kind.value != "angle":
        raise InvalidValue("drive.kind", protocol.drive.kind.value, "'angle' for a flown protocol")
    damping = protocol.tissue.layers[0].interface.viscous_n_mm_s_per_mm or DAMPING
    pilot = pilot_named(controller, Design(needle=protocol.needle, damping_n_mm_s_per_mm=damping))
    step = min(_LOOP_STEP_S, protocol.discretisation.step_s)
    fine = protocol.but(discretisation=protocol.discretisation.but(step_s=step))
    flight = fly(fine.setup(), fine.schedule(), pilot, keep=pilot.log, keep_shape=True)
    about = {
        "protocol": protocol.name,
        "description": f"{protocol.description}; flown by {controller}",
        "controller": controller,
    }
    return record_flight(flight, about)
