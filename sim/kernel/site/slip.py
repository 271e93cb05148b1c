"""Friction at the surface of the shaft: torque per length against slip, and its slope.

Slip rate s is the rate of the shaft relative to the tissue that touches it. Over an
implicit stage of length g the site solves, all at the end of the stage,

    f = beta s (s^2 + plateau^2)^((p-1)/2)            viscous, power law
      + level(s) clamp(z) / z_y,   z = z* + g s       dry: elastic-plastic, z_y presliding
      + shared Z_t / max(|Z|, z_y), Z = Z* + g (s, q v/r)  dry, shared with axial sliding
    level(s) = kinetic + (static - kinetic) exp(-(s/stribeck)^2)

A row may be shaped: its viscous torque follows a curve of the rate, exp of log factors that run
straight over log |s|; its torque is (1 + a) times for positive and (1 - a) times for negative torque;
all of it varies in time with a factor that is an input; and it is times a factor of what the site has
been through, as it was at the start of the stage (sim.kernel.site.curves); where fibres lie one way, of
the direction of the torque, too.

The two-dimensional presliding vector Z is returned to its disc radially: in
steady sliding it gives level * omega / sqrt(omega^2 + (v/r)^2), and at v = 0 it
is a dry element that truly sticks.
"""

import math

from sim.kernel import memory_map
from sim.kernel.compiled import Array, embedded
from sim.kernel.site.curves import contact_factor, past_after, rate_factor, remembered
from sim.kernel.site.memory import Memory, Stage


@embedded
def slip_law(
    s: float, row: Array, extra: float, old: Memory, stage: Stage
) -> tuple[float, float, Memory]:
    """The law where the tissue does not yield.

    Args:
      s: slip rate, rad/s.
      row: of the law table.
      extra: dry level in addition to the row's, N m / m.
      old: memory of the site before the stage.
      stage: see `Stage`.

    Returns:
      torque per length, N m / m, its slope against slip, N m s / rad / m, and the memory that the
      stage leaves. Of a point, none of these is per metre.
    """
    torque, slope = _viscous(s, row)
    more, rise, dry = _dry(s, row, extra, old.dry, stage)
    torque, slope = torque + more, slope + rise
    more, rise, turn, axial = _shared(s, row, old, stage)
    torque, slope = torque + more, slope + rise
    past = old.past
    if row[memory_map.L_SHAPED] != 0.0:
        factor = _factor(torque, row, past, stage)
        torque, slope = factor * torque, factor * slope
        if 0.0 < row[memory_map.L_CONTACT] < memory_map.TWIST:
            slid = s - (dry - old.dry) / stage.g if stage.g > 0.0 else s
            past = past_after(past, slid, stage.g, row)
    return torque, slope, Memory(dry, turn, axial, old.phi, past)


@embedded
def _viscous(s: float, row: Array) -> tuple[float, float]:
    """Torque and slope of the power law, times the curve over the rate."""
    beta, p = row[memory_map.L_VISCOUS], row[memory_map.L_EXPONENT]
    torque, slope = beta * s, beta
    if p != 1.0:
        q = s * s + row[memory_map.L_PLATEAU] ** 2
        m = beta * q ** (0.5 * (p - 1.0))
        torque, slope = m * s, m * (1.0 + (p - 1.0) * s * s / q)
    if row[memory_map.L_SHAPED] != 0.0 and row[memory_map.L_RATE_STEP] > 0.0:
        curve, rise = rate_factor(s, row)
        slope = curve * (slope + rise * (torque / s if s != 0.0 else slope))
        torque *= curve
    return torque, slope


@embedded
def _dry(s: float, row: Array, extra: float, z: float, stage: Stage) -> tuple[float, float, float]:
    """Torque and slope of the dry element, and its presliding, rad."""
    level = row[memory_map.L_KINETIC] + extra
    excess = row[memory_map.L_STATIC] - row[memory_map.L_KINETIC]
    if level <= 0.0 and excess <= 0.0:
        return 0.0, 0.0, z
    limit, fall = stage.yield_angle, 0.0
    if excess > 0.0:
        w = s / row[memory_map.L_STRIBECK]
        bump = excess * math.exp(-w * w)
        level += bump
        fall = 2.0 * bump * w / row[memory_map.L_STRIBECK]
    z += stage.g * s
    slope = level * stage.g / limit if abs(z) < limit else 0.0
    if abs(z) > limit:
        z = math.copysign(limit, z)
    return level * z / limit, slope - fall * z / limit, z


@embedded
def _shared(s: float, row: Array, old: Memory, stage: Stage) -> tuple[float, float, float, float]:
    """Torque and slope of friction shared with the axial motion, and its presliding, rad, either way."""
    shared, turn, axial = row[memory_map.L_SHARED], old.turn, old.axial
    if shared <= 0.0:
        return 0.0, 0.0, turn, axial
    g, limit = stage.g, stage.yield_angle
    turn += g * s
    axial += g * row[memory_map.L_AXIAL] * stage.axial
    size = math.sqrt(turn * turn + axial * axial)
    if size <= limit:
        return shared * turn / limit, shared * g / limit, turn, axial
    slope = shared * g * (axial / size) ** 2 / size
    return shared * turn / size, slope, turn * limit / size, axial * limit / size


@embedded
def _factor(torque: float, row: Array, past: float, stage: Stage) -> float:
    """What shapes all of the torque: its direction, time, and what the site has been through."""
    asymmetry = row[memory_map.L_ASYMMETRY]
    factor = 1.0 + (asymmetry if torque > 0.0 else -asymmetry)
    if row[memory_map.L_VARIES] == memory_map.TORQUE_VARIES:
        factor *= stage.factor
    if 0.0 < row[memory_map.L_CONTACT] < memory_map.TWIST:
        factor *= contact_factor(remembered(past, torque, row), row)[0]
    return factor
