"""Positions of the nodes of the shaft in a recording."""

import numpy as np
from numpy.typing import NDArray

from sim.recording.recording import Recording

Array = NDArray[np.float64]


def node_places_mm(recording: Recording) -> Array:
    """Positions of the nodes along the shaft at every sample, mm from the entry, (N, nodes).

    Negative in front of the tissue. If `stretching` elements share the free length, the others are
    fixed in the tissue; otherwise all nodes move with the needle.
    """
    nodes = np.array(recording.parameters["nodes_mm"], float)
    free = recording["free_mm"][:, None]
    stretching = int(recording.parameters["stretching"])
    if not stretching:
        return np.asarray(nodes - free)
    inside = nodes[stretching:] - nodes[stretching]
    outside = (nodes[:stretching] / nodes[stretching] - 1.0) * free
    return np.hstack([outside, np.broadcast_to(inside, (len(free), inside.size))])
