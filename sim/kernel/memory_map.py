"""The memory map: where a needle and its tissue lie in a MuJoCo model and its data.

Everything that a simulation depends on lives in its `mjModel`: the needle in its
bodies, joints and actuators, the tissue in `numeric` fields. Everything that it
remembers lives in `mjData.userdata`, so that a batch can run different tissues side
by side and a saved state restores exactly. All values are SI. This module is the only
owner of the positions below; the compiled kernel and the Python side both import them.
"""

# --- where the needle is among the model's bodies and joints (the world is body 0) ---
FIRST_BODY = 2  # of the shaft; body 1 is the carriage
FIRST_JOINT = 1  # of the shaft; joint 0 is the carriage's
ABOUT_X = 3  # place of a site actuator's gear about the axis of the needle

# --- numeric "needle": one header ------------------------------------------------
MAGIC = 590_273.0  # marks a model as ours: other models pass the callback untouched
(
    H_MAGIC,
    H_ELEMENTS,  # n
    H_ROWS,  # rows of the law table
    H_ORDER,  # of the step: 1 (MuJoCo's own), 2 or 3
    H_BACKLASH,  # half of the play between drive shaft and needle, rad
    H_UNWINDING,  # stiffness of the drive where the needle is ahead of it, over that the other way
    H_LOOSE,  # half of the play that opens in time, rad
    H_LOOSE_FROM,  # when it begins to, s
    H_LOOSE_OVER,  # in which it opens, s
    H_GRIP,  # torque at which the needle slips in the chuck, N m; 0: never
    H_PRESLIDING,  # angle at which a dry element slips, rad
    H_RADIUS,  # m
    H_ADVECTION,  # c in: slip rate = omega + c v dtheta/dx
    H_STRETCHING,  # elements that share the free length (0: all are fixed to the needle)
    H_FED,  # 1: the shaft comes out of a chuck that stands still, 0: the mesh moves with the chuck
    H_FREE_REF,  # free length at carriage position 0, m
    H_CHAIN,  # 1: joints turn relative to the previous body, 0: to the carriage
    H_STIFFNESS_TORQUE,  # nominal torque at the last place of the curve of stiffness; 0: no curve
    H_STIFFNESS_0,  # log factors of the stiffness at torques from 0, as squares: of either sign
    H_STIFFNESS_1,
    H_STIFFNESS_2,
    H_STIFFNESS_3,
    H_STIFFNESS_4,
    H_STIFFNESS_5,
    H_STIFFNESS_6,
    H_STIFFNESS_7,
    H_STIFFNESS_8,
    H_STIFFNESS_9,
    H_STIFFNESS_10,
    H_STIFFNESS_11,
    H_STIFFNESS_12,
    H_STIFFNESS_13,
    H_STIFFNESS_14,
    H_STIFFNESS_15,
    H_STIFFNESS_16,
    H_STIFFNESS_17,
    H_STIFFNESS_18,
    H_STIFFNESS_19,
    H_STIFFNESS_20,
    H_STIFFNESS_21,
    H_STIFFNESS_22,
    H_STIFFNESS_23,
    H_YIELD,  # torque beyond which the shaft twists plastically, N m; 0: it is elastic
    H_YIELD_SLOPE,  # stiffness beyond it over the elastic one
    H_CREEP,  # twist that a torque adds in time, over the elastic one; 0: none
    H_CREEP_TIME,  # s
    H_SHAFT_DAMPING,  # of a twisted element, over its stiffness, s
    H_STOP,  # angle by which the needle slips in the chuck at most, either way, rad
    H_SPRING,  # that brings it back, N m / rad
    H_JOINT,  # half of the play of a joint in the shaft, rad; 0: there is none
    H_JOINT_AT,  # element that it is in, and the part of it that is in the next one
    HEADER,
) = range(52)
STIFFNESS_POINTS = (H_YIELD - H_STIFFNESS_0) // 2
"""Of either sign."""

# --- numeric "needle_mesh": node positions from the chuck, m (n + 1 values) -------

# --- numeric "needle_law": one row per stretch of shaft, or point of it -----------
# An end is an affine function of the lengths: a + b * free + c * inserted, in m.
(
    L_TOP_CONST,
    L_TOP_FREE,
    L_TOP_INSERTED,
    L_END_CONST,
    L_END_FREE,
    L_END_INSERTED,
    L_POINT,  # 1: acts in one place (the top), with values not per metre
    L_VISCOUS,  # N m s / rad / m
    L_EXPONENT,
    L_PLATEAU,  # rate below which the power law is linear, rad/s
    L_KINETIC,  # N m / m
    L_STATIC,  # N m / m
    L_STRIBECK,  # rad / s
    L_SHARED,  # dry level shared with the axial motion, N m / m
    L_AXIAL,  # share of the axial speed that this counts
    L_STIFFNESS,  # tissue in series, N m / rad / m; 0: rigid
    L_TIME,  # its time constant, s
    L_FOLLOWS,  # power of a factor of its stiffness by which its viscosity goes along
    L_FLOWS,  # its twist beyond which it flows, rad; 0: it is elastic
    L_DRAGGED,  # share of the axial motion by which its twist goes along with the shaft
    L_KERF,  # of its angle from the kerf, what axial motion by a radius takes; 0: there is no kerf
    L_BACKWARDS,  # part of the way back that counts
    L_KERF_ANGLE,  # beyond which its torque hardly grows, rad; 0: it is a sine
    L_CURVATURE,  # N m / m
    L_WAVE,  # viscous torque times a wave over the angle, N m s / rad / m
    L_KEYED,  # dry level times 1 + a wave over the angle, N m / m
    L_PHASE,  # rad
    L_CYCLES,  # of all three in one turn
    L_LOAD,  # dry level over the torque that the shaft carries there
    L_SHAPED,  # 1: one of the following is not neutral
    L_VARIES,  # which part of it is times the input's factor; 0: none
    L_ASYMMETRY,  # its torque is times 1 + this where it is positive, 1 - this where negative
    L_RATE_LOW,  # log of the lowest rate of the curve, rad/s
    L_RATE_STEP,  # of the log of the rate between places of the curve; 0: no curve
    L_CURVE_0,  # log factors of the viscous torque at these rates
    L_CURVE_1,
    L_CURVE_2,
    L_CURVE_3,
    L_CURVE_4,
    L_CURVE_5,
    L_CURVE_6,
    L_CURVE_7,
    L_CURVE_8,
    L_CURVE_9,
    L_CURVE_10,
    L_CURVE_11,
    L_CURVE_12,
    L_CURVE_13,
    L_CURVE_14,
    L_CURVE_15,
    L_CURVE_16,
    L_CURVE_17,
    L_CURVE_18,
    L_CURVE_19,
    L_CURVE_20,
    L_CURVE_21,
    L_CURVE_22,
    L_CONTACT,  # what the curve of the following is over; 0: there is none
    L_CONTACT_SCALE,  # of the curve over that, rad, s or (rad/s)^2
    L_CONTACT_STEP,  # of log(1 + it / scale) between places of the curve
    L_RENEWAL,  # slip that renews a contact, breaks its structure, lays its fibres or turns it back, rad
    L_FADING,  # time in which its heat fades, or its structure heals, s
    L_FIRST,  # share of its structure that is broken at first
    L_CONTACT_0,  # log factors at these places of the torque, or of the tissue's stiffness
    L_CONTACT_1,
    L_CONTACT_2,
    L_CONTACT_3,
    L_CONTACT_4,
    L_CONTACT_5,
    L_CONTACT_6,
    L_CONTACT_7,
    L_CONTACT_8,
    COLUMNS,
) = range(73)
CURVE_POINTS = L_CONTACT - L_CURVE_0
CONTACT_POINTS = COLUMNS - L_CONTACT_0
SLIP_SO_FAR, AGE, HEAT, BROKEN, TURNED, ALIGNED, TWIST, STRAINED = (
    1.0,
    2.0,
    3.0,
    4.0,
    5.0,
    6.0,
    7.0,
    8.0,
)  # what the curve is over; from TWIST on it is on the stiffness, and PHI is the memory of TWIST
TORQUE_VARIES, STIFFNESS_VARIES = 1.0, 2.0  # with the torque varies the stiffness, too

# --- numeric "needle_springs": of siblings alone, N m / rad (n values) -----------------

# --- ctrl -------------------------------------------------------------------------
# U_TISSUE: relative change of the tissue that varies, 0 for none.
U_DRIVE, U_CARRIAGE, U_INSERTED, U_SPEED, U_TIP, U_TISSUE, INPUTS = range(7)

# --- state of one contact site: presliding of the dry element, of the shared one
# (turning, axial), twist of the tissue, slip so far or age; and the slip rate where tissue yields,
# from which the next iteration starts. Two sites per element and row. --
Z_DRY, Z_TURN, Z_AXIAL, PHI, PAST, SLIP, SITE = range(7)

# --- running sums and last values that the sensors show ----------------------------
(
    O_BASE_TORQUE,  # what the drive puts in, N m
    O_BASE_ANGLE,  # of the needle at the chuck, rad
    O_TIP_ANGLE,  # rad
    O_FRICTION,  # sum of the tissue's torque on the shaft, N m
    O_TIP_TORQUE,  # what the tip torque input puts in, N m
    O_WORK,  # done by the drive so far, J
    O_DISSIPATED,  # by friction so far, J
    O_TISSUE_ENERGY,  # stored in twisted tissue, J
    O_SHAFT_ENERGY,  # stored in the twisted shaft, and in a chuck that slips, J
    O_SHAFT_TORQUE,  # largest that an element of the shaft carries, N m
    O_CHUCK_SLIP,  # by which the needle has slipped in the chuck so far, rad
    O_CORRECTION,  # largest torque that lifts MuJoCo's step to a higher order, N m
    O_INERTIA,  # torque that the inertia of the shaft takes, about the start of the step, N m
    O_FAILED,  # stages so far whose iteration did not converge
    O_ITERATIONS,  # of the last step
    O_LANDING,  # largest distance between MuJoCo's step and the wanted state, rad
    OUTPUTS,
) = range(17)

# --- torques that the callback added in the last step, one row each (n + 1 joints) ---
T_TISSUE, T_OTHER, T_CORRECTION, TORQUES = range(4)

# --- userdata: a clock, the state at the start of the step, at its end, the torques,
# and scratch ---
D_PRIMED, D_TIME, CLOCK = range(3)


def block(elements: int, rows: int) -> int:
    """Values in one copy of the state: outputs, inputs, angles, rates, sets of the elements, sites."""
    return OUTPUTS + INPUTS + 3 * elements + 2 + SITE * 2 * elements * rows


def sets_at(elements: int) -> int:
    """Where the sets begin in a copy of the state, after angles and rates."""
    return B_ANGLES + 2 * elements + 2


def sites_at(elements: int) -> int:
    """Where the sites begin in a copy of the state, after angles, rates and sets."""
    return B_ANGLES + 3 * elements + 2


def torques(elements: int) -> int:
    """Values of the torques that the callback added: `TORQUES` rows of a value per joint."""
    return TORQUES * (elements + 1)


def scratch(elements: int, rows: int) -> int:
    """Values of working memory that one step needs: angles, rates, inertia and springs of the
    shaft, then `sim.kernel.stage.workspace`."""
    return 26 * (elements + 1) - 4 + 2 * rows + (4 + 2 * SITE) * elements * rows


def userdata(elements: int, rows: int) -> int:
    """Values of `mjData.userdata`: the state, then working memory (never read back)."""
    return CLOCK + 2 * block(elements, rows) + torques(elements) + scratch(elements, rows)


B_OUTPUTS = 0
B_INPUTS = B_OUTPUTS + OUTPUTS
B_ANGLES = B_INPUTS + INPUTS

OUTPUT_SENSORS = (
    "base_torque",
    "base_angle",
    "tip_angle",
    "friction",
    "tip_torque",
    "work",
    "dissipated",
    "tissue_energy",
    "shaft_energy",
    "shaft_torque",
    "chuck_slip",
    "correction",
    "inertia",
    "failed",
    "iterations",
    "landing",
)
