"""The drive at the first node: a servo with a chuck, or a motor that gives a torque.

Between servo and needle are play, a spring, which may be softer as it unwinds (the needle is ahead),
and a coupling that turns in itself by an angle s where it carries more than it grips:

    |torque - spring s| <= grip,    |s| <= stop

A coupling without stop and spring is a chuck in which the needle slips; one with a stop has play that
rubs; one with both and little grip is soft, then stiff.
"""

import math

from sim.kernel.compiled import inlined
from sim.kernel.stage.workspace import Frame, Workspace


@inlined
def drive_torque(w: Workspace, frame: Frame, drive: float, slip: float = 0.0) -> tuple[float, float]:
    """Torque of the drive on the first node, N m, and minus its slope.

    Args:
      drive: angle at which the servo rests, less what has slipped, rad; or a torque, N m.
      slip: by which the coupling has turned in itself before the stage, rad.
    """
    if frame.servo == 0.0:
        return drive, 0.0
    miss = drive - w.theta[0] - frame.g * w.omega[0]
    engaged = abs(miss) >= frame.backlash
    servo = frame.servo if miss > 0.0 else frame.unwinding * frame.servo
    torque = servo * (miss - slack(miss, frame.backlash))
    pull = torque - frame.spring * slip
    if frame.grip == 0.0 or abs(pull) <= frame.grip:
        return torque, frame.g * servo if engaged else 0.0
    held = math.copysign(frame.grip, pull)
    turns = (pull - held) / (servo + frame.spring)
    left = max(frame.stop - math.copysign(1.0, pull) * slip, 0.0)
    if abs(turns) > left:
        return torque - servo * math.copysign(left, pull), frame.g * servo
    share = frame.spring / (servo + frame.spring)
    return share * torque + (1.0 - share) * (held + frame.spring * slip), frame.g * servo * share


@inlined
def slipped(w: Workspace, frame: Frame, drive: float, torque: float, slip: float) -> float:
    """By how much the needle slips in the chuck within a stage, rad, where its torque is that."""
    if frame.grip == 0.0 or abs(torque - frame.spring * slip) < frame.grip:
        return 0.0
    miss = drive - w.theta[0] - frame.g * w.omega[0]
    servo = frame.servo if miss > 0.0 else frame.unwinding * frame.servo
    return miss - slack(miss, frame.backlash) - torque / servo


@inlined
def taken_up(miss: float, frame: Frame) -> float:
    """What play and a spring that unwinds take up, rad, of an angle: a servo does not feel that part."""
    left = miss - slack(miss, frame.backlash)
    return miss - (left if left > 0.0 else frame.unwinding * left)


@inlined
def slack(miss: float, backlash: float) -> float:
    """How much of the play is taken up, rad, where the drive is ahead of the needle by `miss`."""
    return min(max(miss, -backlash), backlash)
