"""A drive with a spring, play and a dry contact in series: a loop of known shape, quasi-static."""

import numpy as np


def torque_of(angle, *, stiffness, play, level):
    """Torque as the base turns: T = k dead_zone(base - contact), and the contact slips at its level."""
    contact, torque = 0.0, np.zeros(angle.size)
    for i, base in enumerate(angle):
        reach = level / stiffness + play / 2
        contact = min(max(contact, base - reach), base + reach)
        wound = base - contact
        torque[i] = stiffness * np.sign(wound) * max(abs(wound) - play / 2, 0.0)
    return torque


def turns_and_holds(*, amplitude=30.0, rate=20.0, hold_s=1.0, times=4, step_s=0.01):
    """Time and angle of a base that turns to and fro at a constant rate, with holds."""
    at, angle = [0.0, hold_s], [0.0, 0.0]
    for i in range(times):
        to = amplitude * (-1) ** i
        at += [at[-1] + abs(to - angle[-1]) / rate]
        angle += [to]
        at += [at[-1] + hold_s]
        angle += [to]
    time = np.arange(0, at[-1], step_s)
    return time, np.interp(time, at, angle)
