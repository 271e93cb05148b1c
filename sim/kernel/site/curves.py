"""Curves of a row of the law table: over the slip rate, and over what a site has been through.

Both are exp of log factors that run straight between places, and level beyond the last ones. A site
remembers, beside its presliding, one of

    the slip so far    d past / dt = |s|
    its age            d past / dt = 1 - past |s| / renewal
    its heat           d past / dt = (s^2 - past) / fading
    what is broken     d past / dt = (1 - broken) |s| / renewal - broken / fading, broken = first + past
    its turn one way   d past / dt = s - past |s| / renewal (the last term while s is against past)
    how fibres lie     d past / dt = (sign(s) - past) |s| / renewal

where s is the rate at which it slides: of a dry contact, without its presliding. Or its tissue is as
stiff as a curve over its twist says, or over its largest twist so far.
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
def contact_factor(past: float, row: Array) -> tuple[float, float]:
    """Factor after a slip or at a twist, rad, at an age, s, a heat, or a broken share, and its slope."""
    last = memory_map.CONTACT_POINTS - 1
    step, scale = row[memory_map.L_CONTACT_STEP], row[memory_map.L_CONTACT_SCALE]
    at = math.log1p(past / scale) / step
    if at >= last:
        return math.exp(row[memory_map.L_CONTACT_0 + last]), 0.0
    i = int(at)
    below, above = row[memory_map.L_CONTACT_0 + i], row[memory_map.L_CONTACT_0 + i + 1]
    factor = math.exp(below + (at - i) * (above - below))
    return factor, factor * (above - below) / (step * (scale + past))


@embedded
def mean_factor(twist: float, row: Array) -> float:
    """Mean of the factor up to a twist, rad, weighted by the twist: energy over that of factor 1.

    In u = log(1 + x / scale), the integral of exp(a + b u) x dx is one of exponentials.
    """
    if twist == 0.0:
        return math.exp(row[memory_map.L_CONTACT_0])
    step, scale = row[memory_map.L_CONTACT_STEP], row[memory_map.L_CONTACT_SCALE]
    last = memory_map.CONTACT_POINTS - 1
    end, total = math.log1p(twist / scale), 0.0
    for i in range(last):
        low, high = i * step, min((i + 1) * step, end)
        if high > low:
            below = row[memory_map.L_CONTACT_0 + i]
            b = (row[memory_map.L_CONTACT_0 + i + 1] - below) / step
            total += math.exp(below) * (_grown(b, low, high, 2.0) - _grown(b, low, high, 1.0))
    beyond = scale * math.expm1(last * step)
    if twist > beyond:
        rest = 0.5 * (twist * twist - beyond * beyond) / (scale * scale)
        total += math.exp(row[memory_map.L_CONTACT_0 + last]) * rest
    return 2.0 * total * scale * scale / (twist * twist)


@embedded
def _grown(b: float, low: float, high: float, power: float) -> float:
    """Integral of exp(b (u - low) + power u) du from low to high."""
    rate = b + power
    first = math.exp(power * low)
    if abs(rate * (high - low)) < 1e-9:
        return first * (high - low)
    return first * math.expm1(rate * (high - low)) / rate


@embedded
def remembered(past: float, torque: float, row: Array) -> float:
    """What the curve is over: the past without its sign, the broken share, or that of fibres along the
    slip."""
    if row[memory_map.L_CONTACT] == memory_map.ALIGNED:
        return 0.5 * (1.0 + (past if torque > 0.0 else -past))
    if row[memory_map.L_CONTACT] == memory_map.BROKEN:
        return max(row[memory_map.L_FIRST] + past, 0.0)
    return abs(past)


@embedded
def past_after(past: float, s: float, g: float, row: Array) -> float:
    """Slip so far, or one way, rad, age, s, heat, broken share, or how fibres lie, after a stage of
    length g, by backward Euler."""
    if row[memory_map.L_CONTACT] == memory_map.SLIP_SO_FAR:
        return past + g * abs(s)
    if row[memory_map.L_CONTACT] == memory_map.HEAT:
        share = g / row[memory_map.L_FADING]
        return (past + share * s * s) / (1.0 + share)
    slips = g * abs(s) / row[memory_map.L_RENEWAL]
    if row[memory_map.L_CONTACT] == memory_map.BROKEN:
        first = row[memory_map.L_FIRST]
        return (first + past + slips) / (1.0 + slips + g / row[memory_map.L_FADING]) - first
    if row[memory_map.L_CONTACT] == memory_map.TURNED:
        return (past / (1.0 + slips) if past * s < 0.0 else past) + g * s
    if row[memory_map.L_CONTACT] == memory_map.ALIGNED:
        return (past + math.copysign(slips, s)) / (1.0 + slips)
    return (past + g) / (1.0 + slips)
