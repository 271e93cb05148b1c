"""The stage equation of the chain, linearised: one function a kind of term.

    I/g (w - w*) + K (theta* + g w) + D w + sum over sites of N f(N' w) = drive - tip

What is linear (inertia, torsion, viscous rows) is assembled once a step; the
sites of every other row add their torque and slope at each iteration.
"""

import math

from sim.kernel import wire
from sim.kernel.compiled import compiled, inlined
from sim.kernel.law import site_law
from sim.kernel.mesh import XI_LEFT, XI_RIGHT


@inlined
def is_linear(row):
    """Whether a row is viscous friction alone: no state, no iteration."""
    return (
        row[wire.L_EXPONENT] == 1.0
        and row[wire.L_KINETIC] == 0.0
        and row[wire.L_STATIC] == 0.0
        and row[wire.L_SHARED] == 0.0
        and row[wire.L_STIFFNESS] == 0.0
        and row[wire.L_CURVATURE] == 0.0
        and row[wire.L_LOAD] == 0.0
        and row[wire.L_POINT] == 0.0
    )


@inlined
def add_viscous(w, weights, beta):
    """Damping of a viscous row: sum over sites of beta weight N N'."""
    for e in range(weights.shape[0]):
        f0, f1 = beta * weights[e, 0], beta * weights[e, 1]
        mixed = XI_LEFT * XI_RIGHT * (f0 + f1)
        w.damp_diagonal[e] += XI_RIGHT * XI_RIGHT * f0 + XI_LEFT * XI_LEFT * f1
        w.damp_upper[e] += mixed
        w.damp_lower[e + 1] += mixed
        w.damp_diagonal[e + 1] += XI_LEFT * XI_LEFT * f0 + XI_RIGHT * XI_RIGHT * f1


@inlined
def add_viscous_slide(w, weights, beta, frame):
    """Slip of a viscous row because the shaft slides against the mesh, twisted.

    The slip gains drift dtheta/dx: linear in the angles at the end of the stage,
    its part in the rates enters the damping and its part in theta* the residual.
    """
    for e in range(weights.shape[0]):
        per_length = beta * frame.drift / (w.x[e + 1] - w.x[e])
        left = per_length * (XI_RIGHT * weights[e, 0] + XI_LEFT * weights[e, 1])
        right = per_length * (XI_LEFT * weights[e, 0] + XI_RIGHT * weights[e, 1])
        twist = twist_of(w, e, frame.g)
        w.rhs[e] -= left * twist
        w.rhs[e + 1] -= right * twist
        w.diagonal[e] -= frame.g * left
        w.upper[e] += frame.g * left
        w.lower[e + 1] -= frame.g * right
        w.diagonal[e + 1] += frame.g * right


@inlined
def twist_of(w, e, g):
    """Twist of element e at the end of the stage, rad."""
    return w.theta[e + 1] - w.theta[e] + g * (w.omega[e + 1] - w.omega[e])


@inlined
def add_linear(w, g, with_matrix):
    """Inertia, torsion and viscous rows: the residual, and the matrix if wanted."""
    n = w.omega.size - 1
    arriving = 0.0
    for i in range(n + 1):
        leaving = -w.spring[i] * twist_of(w, i, g) if i < n else 0.0
        damping = w.damp_diagonal[i] * w.omega[i]
        if i > 0:
            damping += w.damp_lower[i] * w.omega[i - 1]
        if i < n:
            damping += w.damp_upper[i] * w.omega[i + 1]
        w.rhs[i] = arriving - leaving - damping - w.inertia[i] * (w.omega[i] - w.rest[i])
        arriving = leaving
        if not with_matrix:
            continue
        before = g * w.spring[i - 1] if i > 0 else 0.0
        after = g * w.spring[i] if i < n else 0.0
        w.lower[i] = w.damp_lower[i] - before
        w.upper[i] = w.damp_upper[i] - after
        w.diagonal[i] = w.damp_diagonal[i] + w.inertia[i] + before + after


@inlined
def drive_torque(w, frame, drive):
    """Torque of the drive on the first node, N m, and minus its slope."""
    if not frame.angle_driven:
        return drive, 0.0
    miss = drive - w.theta[0] - frame.g * w.omega[0]
    slack = min(max(miss, -frame.backlash), frame.backlash)
    engaged = abs(miss) >= frame.backlash
    return frame.servo * (miss - slack), frame.g * frame.servo if engaged else 0.0


@compiled
def add_site(w, e, right, weight, row, start, end, frame, tip_torque, cautious):
    """One contact site at the fraction `right` of element e.

    Returns the power that goes into twisted tissue and bent shaft, W, and the
    energy stored in the tissue, J.
    """
    g, left = frame.g, 1.0 - right
    per_length = frame.drift / (w.x[e + 1] - w.x[e])
    slide = per_length * twist_of(w, e, g)
    rate = left * w.omega[e] + right * w.omega[e + 1] + slide
    lag = left * w.lag[e] + right * w.lag[e + 1] + slide
    extra = 0.0
    if row[wire.L_LOAD] > 0.0:
        at_tip = right == 1.0 and e == w.omega.size - 2
        extra = row[wire.L_LOAD] * abs(tip_torque if at_tip else w.spring[e] * twist_of(w, e, g))
    torque, slope, slip = site_law(
        rate, row, extra, start, end, g, frame.axial, frame.yield_angle, lag, cautious
    )
    stiffness = weight * row[wire.L_STIFFNESS]
    recoverable = stiffness * end[wire.PHI] * (rate - slip)
    stored = 0.5 * stiffness * end[wire.PHI] * end[wire.PHI]
    if row[wire.L_CURVATURE] != 0.0:
        angle = left * w.theta[e] + right * w.theta[e + 1] - row[wire.L_PHASE]
        angle += g * (left * w.omega[e] + right * w.omega[e + 1])
        bent = row[wire.L_CURVATURE] * math.sin(angle)
        torque += bent
        slope += g * row[wire.L_CURVATURE] * math.cos(angle)
        recoverable += weight * bent * (rate - slide)
    if cautious and slope < 0.0:
        slope = 0.0
    torque *= weight
    slope *= weight
    tilt = g * per_length
    w.rhs[e] -= left * torque
    w.rhs[e + 1] -= right * torque
    w.diagonal[e] += left * slope * (left - tilt)
    w.upper[e] += left * slope * (right + tilt)
    w.lower[e + 1] += right * slope * (left - tilt)
    w.diagonal[e + 1] += right * slope * (right + tilt)
    return recoverable, stored


@compiled
def add_row(w, r, row, frame, tip_torque, cautious):
    """Every covered site of a row that is more than viscous; returns as `add_site`."""
    if row[wire.L_POINT] != 0.0:
        start, end = w.start[r, 0, 0], w.end[r, 0, 0]
        e, right = int(w.point[r, 0]), w.point[r, 1]
        return add_site(w, e, right, 1.0, row, start, end, frame, tip_torque, cautious)
    recoverable, stored = 0.0, 0.0
    for e in range(w.weights.shape[1]):
        for k in range(2):
            weight = w.weights[r, e, k]
            if weight == 0.0:
                continue
            right = XI_RIGHT if k == 1 else XI_LEFT
            start, end = w.start[r, e, k], w.end[r, e, k]
            power, energy = add_site(w, e, right, weight, row, start, end, frame, tip_torque, cautious)
            recoverable += power
            stored += energy
    return recoverable, stored
