"""The joint torques that the callback adds to MuJoCo's, in three parts.

tissue      what the tissue does to the shaft: -sum of f over the nodes beyond the joint
other       what the model holds and its joints cannot: play of the drive, slip in the chuck, an element
            that yields or whose length changes (k (a_0 / a - 1) times its twist), springs of siblings
correction  what lifts MuJoCo's first-order step to the order of the method, second by default;
            0 in first-order mode

MuJoCo's `discrete` step solves  M a + K q_end = motor + passive,  q_end = q + h qvel_end,
with K its joints' springs. For its step to end at the angles that the method of higher order
found, passive has to be

    M a + K q_end - motor,    a = ((q_end - q) / h - qvel) / h,

of which tissue (in the mean over the step) and other are the physical parts; what is
left is the correction. A first-order step solves the same equation as MuJoCo, so that tissue
and other are all that it adds.
"""

from sim.kernel import memory_map
from sim.kernel.compiled import Array, inlined
from sim.kernel.shaft import Shaft, motor_force


@inlined
def to_joints(chain: bool, nodes: Array) -> None:
    """Torques on nodes, in place, as torques of joints: a joint of the chain turns all beyond it."""
    if chain:
        for i in range(nodes.size - 2, -1, -1):
            nodes[i] += nodes[i + 1]


@inlined
def set_other(
    chain: bool,
    shaft: Shaft,
    spring: Array,
    kept: Array,
    servo_slack: float,
    end: Array,
    other: Array,
) -> None:
    """What the joints of the model cannot hold.

    Args:
      spring: of the elements as long as they are now, N m / rad.
      kept: twist that these keep without a torque, rad.
      servo_slack: play of the drive that is taken up, and slip in the chuck, rad.
      end: angles at the end of the step, rad.
    """
    springs = shaft.spring
    n = end.size - 1
    for i in range(n + 1):
        other[i] = 0.0
    for e in range(n):
        twist = end[e + 1] - end[e]
        if chain:
            other[e + 1] = (springs[e] - spring[e]) * twist + spring[e] * kept[e]
        else:
            torque = spring[e] * (twist - kept[e])
            other[e] += torque
            other[e + 1] -= torque
    other[0] -= shaft.servo * servo_slack


@inlined
def landing_torque(
    chain: bool, shaft: Shaft, h: float, theta: Array, rates: Array, end: Array, ctrl: Array, out: Array
) -> None:
    """M a + K q_end - motor of every hinge: what makes MuJoCo's step end at the angles `end`."""
    inertia, spring = shaft.inertia, shaft.spring
    n = end.size - 1
    tip = motor_force(shaft.tip, ctrl[memory_map.U_TIP])
    inertial = 0.0
    for i in range(n, -1, -1):
        acceleration = ((end[i] - theta[i]) / h - rates[i]) / h
        inertial = inertia[i] * acceleration + (inertial if chain else 0.0)
        torque = inertial
        if i == 0:
            torque += shaft.servo * end[0] - motor_force(shaft.motor, ctrl[memory_map.U_DRIVE])
        elif chain:
            torque += spring[i - 1] * (end[i] - end[i - 1])
        if chain or i == n:
            torque -= tip
        out[i] = torque


@inlined
def landing_force(shaft: Shaft, h: float, place: float, speed: float, ctrl: float) -> float:
    """The same for the carriage, which is to end where its input says, N."""
    acceleration = ((ctrl - place) / h - speed) / h
    return shaft.mass * acceleration + shaft.rail * ctrl - motor_force(shaft.rail_motor, ctrl)


@inlined
def inertia_torque(shaft: Shaft, h: float, theta: Array, rates: Array, state: Array) -> float:
    """Torque that the shaft's inertia takes, N m.

    From the mean rate of the last step (MuJoCo's) to that of this one, and so about the start
    of this step.

    Args:
      state: block with the angles at the end of this step.
    """
    inertia = shaft.inertia
    total = 0.0
    for i in range(theta.size):
        end = state[memory_map.B_ANGLES + i]
        total += inertia[i] * ((end - theta[i]) / h - rates[i]) / h
    return total
