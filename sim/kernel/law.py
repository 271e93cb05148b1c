"""The law of one contact site: torque per length against slip, and its slope.

Slip rate s is the rate of the shaft relative to the tissue that touches it. Over an
implicit stage of length g the site solves, all at the end of the stage,

    f = beta s (s^2 + plateau^2)^((p-1)/2)            viscous, power law
      + level(s) clamp(z) / z_y,   z = z* + g s       dry: elastic-plastic, z_y presliding
      + shared Z_t / max(|Z|, z_y), Z = Z* + g (s, q v/r)  dry, shared with axial sliding
    level(s) = kinetic + (static - kinetic) exp(-(s/stribeck)^2)

and, where the tissue yields (Kelvin-Voigt, in series with all of the above),

    f = k phi + k tau dphi/dt,   dphi/dt = omega - s,   phi = phi* + g dphi/dt,

with k times a curve over |phi| where it hardens or softens, or over the largest |phi| so far where it
softens for good, and |phi| at most that at which it flows. In its kerf the tip does not slip
(sim.kernel.kerf), and phi is the angle from it.

A row may be shaped: its viscous torque follows a curve of the rate, exp of log factors that run
straight over log |s|; its torque is (1 + a) times for positive and (1 - a) times for negative torque;
all of it, or k alone, varies in time with a factor that is an input (k tau then with a power of that);
and it is times a factor of what the site has been through, as it was at the start of the stage
(sim.kernel.stage.curves); where fibres lie one way, of the direction of the torque, too.

The two-dimensional presliding vector Z is returned to its disc radially: in
steady sliding it gives level * omega / sqrt(omega^2 + (v/r)^2), and at v = 0 it
is a dry element that truly sticks.
"""

import math
from typing import NamedTuple

from sim.kernel import memory_map
from sim.kernel.compiled import Array, embedded
from sim.kernel.kerf import in_kerf
from sim.kernel.stage.curves import contact_factor, past_after, rate_factor, remembered

_INNER_ITERATIONS = 40
_LEAST_RISE = 1e-6  # of the tissue's slope, where friction falls as fast as tissue gives way
_LEAST = 0.1  # of the slope at the same stiffness, that tissue which softens has for Newton's method


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
    torque, slope = 0.0, 0.0
    dry, turn, axial, past = old.dry, old.turn, old.axial, old.past
    g, limit = stage.g, stage.yield_angle
    viscous = row[memory_map.L_VISCOUS]
    p = row[memory_map.L_EXPONENT]
    if p == 1.0:
        torque = viscous * s
        slope = viscous
    elif viscous != 0.0:
        q = s * s + row[memory_map.L_PLATEAU] ** 2
        m = viscous * q ** (0.5 * (p - 1.0))
        torque = m * s
        slope = m * (1.0 + (p - 1.0) * s * s / q)
    shaped = row[memory_map.L_SHAPED] != 0.0
    if shaped and row[memory_map.L_RATE_STEP] > 0.0:
        curve, rise = rate_factor(s, row)
        slope = curve * (slope + rise * (torque / s if s != 0.0 else slope))
        torque *= curve
    level = row[memory_map.L_KINETIC] + extra
    excess = row[memory_map.L_STATIC] - row[memory_map.L_KINETIC]
    if level > 0.0 or excess > 0.0:
        if excess > 0.0:
            w = s / row[memory_map.L_STRIBECK]
            bump = excess * math.exp(-w * w)
            level += bump
        dry += g * s
        size = abs(dry)
        if size < limit:
            slope += level * g / limit
        if size > limit:
            dry = math.copysign(limit, dry)
        torque += level * dry / limit
        if excess > 0.0:
            slope -= 2.0 * bump * w / row[memory_map.L_STRIBECK] * dry / limit
    shared = row[memory_map.L_SHARED]
    if shared > 0.0:
        turn += g * s
        axial += g * row[memory_map.L_AXIAL] * stage.axial
        size = math.sqrt(turn * turn + axial * axial)
        if size <= limit:
            torque += shared * turn / limit
            slope += shared * g / limit
        else:
            torque += shared * turn / size
            slope += shared * g * (axial / size) ** 2 / size
            turn, axial = turn * limit / size, axial * limit / size
    if shaped:
        asymmetry = row[memory_map.L_ASYMMETRY]
        factor = 1.0 + (asymmetry if torque > 0.0 else -asymmetry)
        factor *= stage.factor if row[memory_map.L_VARIES] == memory_map.TORQUE_VARIES else 1.0
        if 0.0 < row[memory_map.L_CONTACT] < memory_map.TWIST:
            factor *= contact_factor(remembered(past, torque, row), row)[0]
            slid = s - (dry - old.dry) / g if level > 0.0 and g > 0.0 else s
            past = past_after(past, slid, g, row)
        torque, slope = torque * factor, slope * factor
    return torque, slope, Memory(dry, turn, axial, old.phi, past)


@embedded
def site_law(
    omega: float, row: Array, extra: float, old: Memory, stage: Stage, slip: float
) -> tuple[float, float, float, Memory]:
    """As `slip_law`, against the rate of the shaft, rad/s, with the tissue in series.

    Args:
      slip: slip rate from which the iteration starts, rad/s: the last one of this site.

    Returns:
      torque per length, N m / m, its slope against omega, N m s / rad / m, the slip rate, rad/s,
      and the memory that the stage leaves.
    """
    k, tau = row[memory_map.L_STIFFNESS], row[memory_map.L_TIME]
    if row[memory_map.L_VARIES] != 0.0:
        k *= stage.factor
    if row[memory_map.L_VARIES] == memory_map.STIFFNESS_VARIES:
        tau *= stage.factor ** (row[memory_map.L_FOLLOWS] - 1.0)
    if row[memory_map.L_KERF] > 0.0:
        held = in_kerf(omega, row, old.phi, stage.g, stage.axial)
        return held.torque, held.slope, 0.0, Memory(old.dry, old.turn, old.axial, held.phi, old.past)
    if k <= 0.0:
        torque, slope, new = slip_law(omega, row, extra, old, stage)
        return torque, slope, omega, new
    # torque(s) - elastic(omega - s) = 0: bracketed Newton. Where friction falls so fast with s that
    # this falls, too, the slope of the tissue alone points to where it rises. The last step is
    # straight: what it misses is of the order of its square.
    s, low, high = slip, -math.inf, math.inf
    share, least = _slip_tolerance(row, extra)
    torque, slope, new = slip_law(s, row, extra, old, stage)
    elastic, resistance = _elastic(omega - s, k, tau, row, old, stage.g)
    rise, change = slope + resistance, 0.0
    for _ in range(_INNER_ITERATIONS):
        miss = torque - elastic
        if miss > 0.0:
            high = s
        else:
            low = s
        change = miss / (rise if rise > _LEAST_RISE * resistance else resistance)
        if abs(change) <= share * (abs(s) + least):
            break
        s -= change
        if not low < s < high:
            s = 0.5 * (low + high)
        torque, slope, new = slip_law(s, row, extra, old, stage)
        elastic, resistance = _elastic(omega - s, k, tau, row, old, stage.g)
        rise, change = slope + resistance, 0.0
    s -= change
    phi = _held(old.phi + stage.g * (omega - s), row)
    past = max(new.past, abs(phi)) if row[memory_map.L_CONTACT] == memory_map.STRAINED else new.past
    left = Memory(new.dry, new.turn, new.axial, phi, past)
    rise = max(rise, _LEAST_RISE * resistance)
    return torque - slope * change, slope * resistance / rise, s, left


@embedded
def _slip_tolerance(row: Array, extra: float) -> tuple[float, float]:
    """Of the last change of the slip rate of a site in tissue that yields, relative above a rate, rad/s:
    rounding where there is a memory, little where there are corners, 0.1 ppm of a smooth law, any of a
    straight one."""
    dry = row[memory_map.L_KINETIC] + row[memory_map.L_STATIC] + row[memory_map.L_SHARED] + extra
    if dry > 0.0 or row[memory_map.L_FLOWS] > 0.0 or 0.0 < row[memory_map.L_CONTACT] < memory_map.TWIST:
        return 1e-13, 1.0
    if row[memory_map.L_CONTACT] != 0.0 or row[memory_map.L_RATE_STEP] > 0.0:
        return 1e-6, 1.0
    if row[memory_map.L_EXPONENT] != 1.0:
        return 1e-7, row[memory_map.L_PLATEAU]
    return math.inf, 1.0


@embedded
def _elastic(
    rate: float, k: float, tau: float, row: Array, old: Memory, g: float
) -> tuple[float, float]:
    """Torque of the tissue where it yields at a rate, rad/s, and its slope, which stays positive."""
    phi = old.phi + g * rate
    held = _held(phi, row)
    torque, resistance = held + tau * rate, tau + (g if held == phi else _LEAST * g)
    phi = held
    if row[memory_map.L_CONTACT] == memory_map.TWIST:
        factor, rise = contact_factor(abs(phi), row)
        more = math.copysign(rise, phi) * g * torque
        resistance *= factor
        torque, resistance = factor * torque, max(resistance + more, _LEAST * resistance)
    elif row[memory_map.L_CONTACT] == memory_map.STRAINED:
        k *= contact_factor(old.past, row)[0]
    return k * torque, k * resistance


@embedded
def _held(phi: float, row: Array) -> float:
    """The twist of the tissue that lasts, rad: where it flows, no more than that."""
    most = row[memory_map.L_FLOWS]
    return min(max(phi, -most), most) if most > 0.0 else phi
