"""The state of a trial, the inputs of a step, and the workspace of Newton's method."""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

Array = NDArray[np.float64]

ENTRY, TIP, CHUCK = 0, 1, 2
"""Where `lumped` keeps the presliding of entry and tip, and how far the chuck has slipped."""


class RigState(NamedTuple):
    """The internal variables between steps; shapes (nodes,), (points,) and (3,).

    Attributes:
      angle, angle_before: rad, after this step and after the one before it.
      presliding, turning, axial, sheath: presliding of dry friction, of shared friction (two
        components), and of the sheath, rad.
      age: of the contact, s; worn: travelled slip, rad; set_twist: permanent, of links, rad.
      tissue_twist, tissue_twist_before: at points of the tissue, rad.
      lumped: see `ENTRY`, `TIP`, `CHUCK`.
    """

    angle: Array
    angle_before: Array
    presliding: Array
    turning: Array
    axial: Array
    sheath: Array
    age: Array
    worn: Array
    set_twist: Array
    tissue_twist: Array
    tissue_twist_before: Array
    lumped: Array


class NewtonWorkspace(NamedTuple):
    """Arrays of one step, per node, (nodes,).

    Attributes:
      angle, twist: unknowns: angle of the shaft and twist of the tissue, rad.
      angle_past, twist_past: past part of their rates, rad/s; twist_now: twist at the start, rad.
      torque: of the interface, N mm / mm.
      lower, diagonal, upper, residual: rows of the tridiagonal system.
      twist_increment, twist_gain: Newton step of the twist, and its slope with that of the angle.
      increment: Newton step of the angle, rad.
      lagged_rate: slip rate at which the dry level may be taken, rad/s.
    """

    angle: Array
    twist: Array
    angle_past: Array
    twist_past: Array
    twist_now: Array
    torque: Array
    lower: Array
    diagonal: Array
    upper: Array
    residual: Array
    twist_increment: Array
    twist_gain: Array
    increment: Array
    lagged_rate: Array


class StepInput(NamedTuple):
    """The inputs at the end of a step; rates are lead * value + past.

    Attributes:
      base, tip_torque: rad, N mm.
      lead: coefficient of the new value in a rate, 1/s.
      axial_travel: axial travel within the step / radius.
      time, speed: s, mm/s.
    """

    base: float
    tip_torque: float
    lead: float
    axial_travel: float
    time: float
    speed: float


@njit(cache=True)
def initial_state(nodes: int, places: int, angle: float) -> RigState:
    """Untwisted and at rest at that angle, rad, in the middle of the chuck's play."""
    n, p = np.zeros((9, nodes)), np.zeros((2, places))
    n[:2] = angle
    return RigState(n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8], p[0], p[1], np.zeros(3))


@njit(cache=True)
def workspace(nodes: int) -> NewtonWorkspace:
    """Zeros for that many nodes."""
    n = np.zeros((14, nodes))
    return NewtonWorkspace(
        n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8], n[9], n[10], n[11], n[12], n[13]
    )
