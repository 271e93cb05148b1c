"""The twist of a recorded shaft in the modes of the closed form."""

import numpy as np
from numpy.typing import NDArray

from models.modes import InsertedNeedle
from models.needle import Needle
from models.tissue import Tissue
from sim.recording.recording import Recording

Array = NDArray[np.float64]

MODES = 4


def modal_amplitudes_deg(recording: Recording, count: int = MODES) -> Array | None:
    """Amplitudes of the closed form's modes in the shape of the shaft, deg, (N, count).

    They are those of the lag behind the base, theta - u, in the modes of the base-driven needle at
    each depth. None if the recording has no shape, or the tissue no damping.
    """
    angles, nodes = recording.group("shaft"), recording.parameters.get("nodes_mm")
    if not angles.size or nodes is None:
        return None
    tissue = Tissue(**recording.parameters["tissue"])
    damping = tissue.layers[0].interface.viscous_n_mm_s_per_mm
    if damping == 0 or recording["inserted_mm"].max() <= 0:
        return None
    needle = Needle(**recording.parameters["needle"])
    lag = angles - recording["base_angle_deg"][:, None]
    amplitudes = np.zeros((len(lag), count))
    x, cache = np.array(nodes), {}
    for i, (free, inserted) in enumerate(
        zip(recording["free_mm"], recording["inserted_mm"], strict=True)
    ):
        key = (round(free, 1), round(inserted, 1))
        if inserted <= 1.0:
            continue
        if key not in cache:
            cache[key] = _projector(needle, damping, *key, x, recording.parameters["stretching"], count)
        amplitudes[i] = cache[key] @ lag[i]
    return amplitudes


def _projector(
    needle: Needle,
    damping: float,
    free: float,
    inserted: float,
    nodes: Array,
    stretching: int,
    count: int,
) -> Array:
    """Matrix from angles at the nodes to amplitudes: least squares on the inserted nodes."""
    held = InsertedNeedle(
        needle=needle, damping_n_mm_s_per_mm=damping, inserted_mm=inserted, free_mm=free
    )
    depth = nodes - nodes[stretching] if stretching else nodes - free
    inside = (depth >= -1e-6) & (depth <= inserted + 1e-6)
    shapes = np.cos(np.outer(inserted - depth[inside], held.wavenumbers_per_mm(count)))
    projector = np.zeros((count, nodes.size))
    projector[:, inside] = np.linalg.pinv(shapes)
    return projector
