"""Curves of a row of the law table: over the slip rate, and over what a site has been through.

Both are exp of log factors that run straight between places, and level beyond the last ones. A site
remembers, beside its presliding, one of

    the slip so far    d past / dt = |s|
    its age            d past / dt = 1 - past |s| / renewal
"""

import math

from sim.kernel import memory_map
from sim.kernel.compiled import Array, embedded


@embedded
def rate_factor(s: float, row: Array) -> tuple[float, float]:
    """Factor of the viscous torque at a slip rate, rad/s, and d log factor / d log rate."""
    size = max(abs(s), row[memory_map.L_PLATEAU])
    at = (math.log(size) - row[memory_map.L_RATE_LOW]) / row[memory_map.L_RATE_STEP]
    last = memory_map.CURVE_POINTS - 1
    if at <= 0.0:
        return math.exp(row[memory_map.L_CURVE_0]), 0.0
    if at >= last:
        return math.exp(row[memory_map.L_CURVE_0 + last]), 0.0
    i = int(at)
    below, above = row[memory_map.L_CURVE_0 + i], row[memory_map.L_CURVE_0 + i + 1]
    log_factor = below + (at - i) * (above - below)
    return math.exp(log_factor), (above - below) / row[memory_map.L_RATE_STEP]


@embedded
def contact_factor(past: float, row: Array) -> float:
    """Factor of the torque after a slip, rad, or at an age, s."""
    last = memory_map.CONTACT_POINTS - 1
    at = math.log1p(past / row[memory_map.L_CONTACT_SCALE]) / row[memory_map.L_CONTACT_STEP]
    if at >= last:
        return math.exp(row[memory_map.L_CONTACT_0 + last])
    i = int(at)
    below, above = row[memory_map.L_CONTACT_0 + i], row[memory_map.L_CONTACT_0 + i + 1]
    return math.exp(below + (at - i) * (above - below))


@embedded
def past_after(past: float, s: float, g: float, row: Array) -> float:
    """Slip so far, rad, or age, s, at the end of a stage of length g, by backward Euler."""
    if row[memory_map.L_CONTACT] == memory_map.SLIP_SO_FAR:
        return past + g * abs(s)
    return (past + g) / (1.0 + g * abs(s) / row[memory_map.L_RENEWAL])
