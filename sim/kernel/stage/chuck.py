"""The drive at the first node: a servo with a chuck, or a motor that gives a torque.

Between servo and needle are play, and a coupling that turns in itself by an angle s where it carries
more than it grips:

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
    torque = frame.servo * (miss - slack(miss, frame.backlash))
    pull = torque - frame.spring * slip
    if frame.grip == 0.0 or abs(pull) <= frame.grip:
        return torque, frame.g * frame.servo if engaged else 0.0
    held = math.copysign(frame.grip, pull)
    turns = (pull - held) / (frame.servo + frame.spring)
    left = max(frame.stop - math.copysign(1.0, pull) * slip, 0.0)
    if abs(turns) > left:
        return torque - frame.servo * math.copysign(left, pull), frame.g * frame.servo
    share = frame.spring / (frame.servo + frame.spring)
    return share * torque + (1.0 - share) * (held + frame.spring * slip), frame.g * frame.servo * share


@inlined
def slipped(w: Workspace, frame: Frame, drive: float, torque: float, slip: float) -> float:
    """By how much the needle slips in the chuck within a stage, rad, where its torque is that."""
    if frame.grip == 0.0 or abs(torque - frame.spring * slip) < frame.grip:
        return 0.0
    miss = drive - w.theta[0] - frame.g * w.omega[0]
    return miss - slack(miss, frame.backlash) - torque / frame.servo


@inlined
def slack(miss: float, backlash: float) -> float:
    """How much of the play is taken up, rad, where the drive is ahead of the needle by `miss`."""
    return min(max(miss, -backlash), backlash)
