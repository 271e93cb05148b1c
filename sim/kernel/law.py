"""The law of one contact site: torque per length against slip, and its slope.

Slip s is the rate of the shaft relative to the tissue that touches it. Over an
implicit stage of length g the site solves, all at the end of the stage,

    f = beta s |s|^(p-1)                              viscous, power law
      + level(s) clamp(z) / z_y,   z = z* + g s       dry: elastic-plastic, z_y presliding
      + shared Z_t / max(|Z|, z_y), Z = Z* + g (s, v/r)  dry, shared with axial sliding
    level(s) = kinetic + (static - kinetic) exp(-(s/stribeck)^2)

and, where the tissue yields (Kelvin-Voigt, in series with all of the above),

    f = k phi + k tau dphi/dt,   dphi/dt = omega - s,   phi = phi* + g dphi/dt.

The two-dimensional presliding vector Z is returned to its disc radially: in
steady sliding it gives level * omega / sqrt(omega^2 + (v/r)^2), and at v = 0 it
is a dry element that truly sticks.
"""

import math

from sim.kernel import wire
from sim.kernel.compiled import compiled, inlined

# Below this rate the power law is linear, so that its slope stays finite: rad/s.
RATE_FLOOR = 1e-5
_INNER_ITERATIONS = 40


@compiled
def slip_law(s, law, extra, start, end, g, axial, yield_angle, lag, cautious):
    """Torque per length and its slope against slip; writes presliding to `end`.

    Args:
      s: slip rate, rad/s.
      law: a row of the law table.
      extra: dry level in addition to the row's, N m / m.
      start, end: the site's state before and after the stage.
      g: length of the implicit stage, s.
      axial: axial speed over the radius, rad/s.
      yield_angle: presliding angle, rad.
      lag: slip rate at the start of the stage, rad/s.
      cautious: take slopes that cannot mislead Newton's method: the secant of the
        power law, and the Stribeck level of `lag`.
    """
    torque = 0.0
    slope = 0.0
    viscous = law[wire.L_VISCOUS]
    if viscous != 0.0:
        p = law[wire.L_EXPONENT]
        if p == 1.0:
            torque += viscous * s
            slope += viscous
        else:
            q = s * s + RATE_FLOOR * RATE_FLOOR
            m = viscous * q ** (0.5 * (p - 1.0))
            torque += m * s
            slope += m if cautious else m * (1.0 + (p - 1.0) * s * s / q)
    kinetic = law[wire.L_KINETIC] + extra
    excess = law[wire.L_STATIC] - law[wire.L_KINETIC]
    if kinetic > 0.0 or excess > 0.0:
        level = kinetic
        tilt = 0.0
        if excess > 0.0:
            w = (lag if cautious else s) / law[wire.L_STRIBECK]
            bump = excess * math.exp(-w * w)
            level += bump
            tilt = 0.0 if cautious else -2.0 * bump * w / law[wire.L_STRIBECK]
        z = start[wire.Z_DRY] + g * s
        unclamped = abs(z) < yield_angle
        if not unclamped:
            z = math.copysign(yield_angle, z)
        end[wire.Z_DRY] = z
        torque += level * z / yield_angle
        slope += tilt * z / yield_angle
        if unclamped:
            slope += level * g / yield_angle
    shared = law[wire.L_SHARED]
    if shared > 0.0:
        zt = start[wire.Z_TURN] + g * s
        za = start[wire.Z_AXIAL] + g * axial
        size = math.sqrt(zt * zt + za * za)
        if size <= yield_angle:
            torque += shared * zt / yield_angle
            slope += shared * g / yield_angle
            end[wire.Z_TURN], end[wire.Z_AXIAL] = zt, za
        else:
            torque += shared * zt / size
            slope += shared * g * (za / size) ** 2 / size
            end[wire.Z_TURN], end[wire.Z_AXIAL] = zt * yield_angle / size, za * yield_angle / size
    return torque, slope


@compiled
def site_law(omega, law, extra, start, end, g, axial, yield_angle, lag, cautious):
    """As `slip_law`, against the rate of the shaft, with the tissue in series.

    Returns torque per length, its slope against omega, and the slip rate.
    """
    k = law[wire.L_STIFFNESS]
    if k <= 0.0:
        torque, slope = slip_law(omega, law, extra, start, end, g, axial, yield_angle, lag, cautious)
        return torque, slope, omega
    resistance = k * (law[wire.L_TIME] + g)
    push = k * start[wire.PHI]
    s = omega
    torque, slope = slip_law(s, law, extra, start, end, g, axial, yield_angle, lag, cautious)
    # torque(s) - push - resistance (omega - s) = 0: rising in s, so bracketed Newton.
    low, high = -math.inf, math.inf
    for _ in range(_INNER_ITERATIONS):
        miss = torque - push - resistance * (omega - s)
        if miss > 0.0:
            high = s
        else:
            low = s
        step = miss / (slope + resistance)
        if abs(step) <= 1e-13 * (1.0 + abs(s)):
            break
        s -= step
        if not low < s < high:
            s = 0.5 * (low + high) if math.isfinite(low) and math.isfinite(high) else s
        torque, slope = slip_law(s, law, extra, start, end, g, axial, yield_angle, lag, cautious)
    end[wire.PHI] = start[wire.PHI] + g * (omega - s)
    return torque, slope * resistance / (slope + resistance), s
