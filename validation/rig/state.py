"""What a trial remembers from step to step, and the space that a step works in."""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

Array = NDArray[np.float64]

ENTRY, TIP, CHUCK = 0, 1, 2
"""Where `lumped` keeps the presliding of entry and tip, and how far the chuck has slipped."""


class State(NamedTuple):
    """Angles and memories of nodes, now and before; twist of places in the tissue; lumped elements."""

    angle: Array
    angle_before: Array
    presliding: Array
    turning: Array
    axial: Array
    sheath: Array
    age: Array
    worn: Array
    places: Array
    places_before: Array
    lumped: Array


class Work(NamedTuple):
    """Per node: the angles and twists sought, what they remember, a Newton step, frozen slip rates."""

    angle: Array
    twist: Array
    angle_past: Array
    twist_past: Array
    twist_now: Array
    torque: Array
    lower: Array
    own: Array
    upper: Array
    force: Array
    twist_force: Array
    twist_gain: Array
    turn: Array
    frozen: Array


class Push(NamedTuple):
    """What acts from outside at the end of a step; rates are lead * value + past."""

    base: float
    tip_torque: float
    lead: float
    axial_travel: float


@njit(cache=True)
def at_rest(nodes: int, places: int, angle: float) -> State:
    """Untwisted, at that angle, in the middle of the chuck's play."""
    n, p = np.zeros((8, nodes)), np.zeros((2, places))
    n[:2] = angle
    return State(n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], p[0], p[1], np.zeros(3))


@njit(cache=True)
def space(nodes: int) -> Work:
    """For the steps of a mesh with that many nodes."""
    n = np.zeros((14, nodes))
    return Work(n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8], n[9], n[10], n[11], n[12], n[13])
