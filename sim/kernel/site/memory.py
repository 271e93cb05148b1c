"""What a contact site remembers, and what all sites of a row share during a stage."""

from typing import NamedTuple

from sim.kernel import memory_map
from sim.kernel.compiled import Array, embedded


class Memory(NamedTuple):
    """What a site remembers: presliding and twist of the tissue, rad, slip so far, rad, or age, s."""

    dry: float
    turn: float
    axial: float
    phi: float
    past: float = 0.0


class Stage(NamedTuple):
    """What all sites of a row share during a stage."""

    g: float  # length of the implicit stage, s
    axial: float  # axial speed over the radius, rad/s
    yield_angle: float  # presliding angle, rad
    factor: float = 1.0  # of rows that vary in time


@embedded
def recall(state: Array) -> Memory:
    """What a site remembers, from its state."""
    return Memory(
        state[memory_map.Z_DRY],
        state[memory_map.Z_TURN],
        state[memory_map.Z_AXIAL],
        state[memory_map.PHI],
        state[memory_map.PAST],
    )


@embedded
def remember(state: Array, new: Memory, slip: float) -> None:
    """Write what a stage leaves into the state of a site; `slip` is its slip rate, rad/s."""
    state[memory_map.Z_DRY] = new.dry
    state[memory_map.Z_TURN] = new.turn
    state[memory_map.Z_AXIAL] = new.axial
    state[memory_map.PHI] = new.phi
    state[memory_map.PAST] = new.past
    state[memory_map.SLIP] = slip
