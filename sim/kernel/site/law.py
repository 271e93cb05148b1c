"""The law of one contact site: torque per length against the rate of the shaft, and its slope.

Friction acts at the surface of the shaft, against its slip rate s (sim.kernel.site.slip). Where the
tissue yields (Kelvin-Voigt, in series with that), over an implicit stage of length g

    f(s) = k phi + k tau dphi/dt,   dphi/dt = omega - s,   phi = phi* + g dphi/dt,

with k times a curve over |phi| where it hardens or softens, or over the largest |phi| so far where it
softens for good, or times a factor that is an input, and k tau then times a power of the same; and |phi|
is at most that at which it flows. In its kerf the tip does not slip (sim.kernel.site.kerf), and phi is
the angle from it.
"""

import math

from sim.kernel import memory_map
from sim.kernel.compiled import Array, embedded
from sim.kernel.site.curves import contact_factor
from sim.kernel.site.kerf import in_kerf
from sim.kernel.site.memory import Memory, Stage
from sim.kernel.site.slip import slip_law

_INNER_ITERATIONS = 40
_LEAST_RISE = 1e-6  # of the tissue's slope, where friction falls as fast as tissue gives way
_LEAST = 0.1  # of the slope at the same stiffness, that tissue which softens has for Newton's method


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
    yields = g if held == phi else _LEAST * g
    if row[memory_map.L_CONTACT] < memory_map.TWIST:
        return k * (held + tau * rate), k * (tau + yields)
    twists = row[memory_map.L_CONTACT] == memory_map.TWIST
    factor, rise = contact_factor(abs(held) if twists else old.past, row)
    follows = row[memory_map.L_FOLLOWS]
    tau *= factor ** (follows - 1.0)
    torque, resistance = factor * (held + tau * rate), factor * (tau + yields)
    if twists:
        more = math.copysign(rise, held) * g * (held + follows * tau * rate)
        resistance = max(resistance + more, _LEAST * resistance)
    return k * torque, k * resistance


@embedded
def _held(phi: float, row: Array) -> float:
    """The twist of the tissue that lasts, rad: where it flows, no more than that."""
    most = row[memory_map.L_FLOWS]
    return min(max(phi, -most), most) if most > 0.0 else phi
