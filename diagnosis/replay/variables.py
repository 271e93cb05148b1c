"""The variables that a free law may depend on, from the inputs and outputs of a trial.

time           since the trial began, s
trial_share    the same over the duration of the trial
base_angle     of the drive shaft, deg
rate           at which the drive shaft turns, rad/s
acceleration   of the drive shaft, rad/s^2
direction      in which it last turned: 1 forwards, -1 backwards, straight between over a short time
slid_direction in which dry friction in the drive slides: straight between while it sticks
axial_speed    of the needle into the tissue, mm/s
slid_lately    axial speed either way, mm/s, as a mean over the last seconds (SLID_S)
pushed_lately  axial speed with its sign, mm/s, as the same mean
rested         time since the needle last slid, s; as long as any before it has (RESTED_S)
axial_drag     inserted length, with the sign of the axial speed, mm: what the friction of a needle that
               slides is proportional to; 0 at rest
thrust         inserted length where the needle is pushed, with the sign of slid_direction, mm: what the
               friction of a thrust bearing is proportional to
axial_flow     inserted length times axial speed, mm^2/s: what the viscous drag of a sliding needle is
               proportional to
depth          inserted length, mm
free           length of the shaft before the tissue, mm
advanced_by    advance since the needle last moved the other way, mm
slid           how far the needle has slid since the start of the trial, into the tissue less back, mm
travelled      the same, in both directions together, mm
history        total angle that the drive shaft has turned so far, in both directions, turns
tip_angle      deg
tip_rate       rad/s
tip_direction  in which the tip last turned, as direction
torque         torque on the needle at the chuck, N mm
torque_rate    N mm / s
past           time constant, s, with which a reading follows what it shows
turned_by      turn since the last reversal, for a reading with hysteresis, in its own unit
lag            of a reading or the needle in its chuck behind what it follows, in its own unit
held_by        by how much a value may differ from a reading that stays until then, in its own unit
"""

from collections.abc import Mapping
from enum import StrEnum


class Variable(StrEnum):
    """A variable of a free law."""

    TIME = "time"
    TRIAL_SHARE = "trial_share"
    BASE_ANGLE = "base_angle"
    RATE = "rate"
    ACCELERATION = "acceleration"
    DIRECTION = "direction"
    SLID_DIRECTION = "slid_direction"
    AXIAL_SPEED = "axial_speed"
    SLID_LATELY = "slid_lately"
    PUSHED_LATELY = "pushed_lately"
    RESTED = "rested"
    AXIAL_DRAG = "axial_drag"
    THRUST = "thrust"
    AXIAL_FLOW = "axial_flow"
    DEPTH = "depth"
    FREE = "free"
    ADVANCED_BY = "advanced_by"
    SLID = "slid"
    TRAVELLED = "travelled"
    HISTORY = "history"
    TIP_ANGLE = "tip_angle"
    TIP_RATE = "tip_rate"
    TIP_DIRECTION = "tip_direction"
    TORQUE = "torque"
    TORQUE_RATE = "torque_rate"
    PAST = "past"
    TURNED_BY = "turned_by"
    LAG = "lag"
    HELD_BY = "held_by"


UNITS = {
    Variable.TIME: "s",
    Variable.TRIAL_SHARE: "of the trial",
    Variable.BASE_ANGLE: "deg",
    Variable.RATE: "rad/s",
    Variable.ACCELERATION: "rad/s^2",
    Variable.DIRECTION: "-",
    Variable.SLID_DIRECTION: "-",
    Variable.AXIAL_SPEED: "mm/s",
    Variable.SLID_LATELY: "mm/s",
    Variable.PUSHED_LATELY: "mm/s",
    Variable.RESTED: "s",
    Variable.AXIAL_DRAG: "mm, with the sign of the axial speed",
    Variable.THRUST: "mm, with the sign of the direction",
    Variable.AXIAL_FLOW: "mm^2/s",
    Variable.DEPTH: "mm",
    Variable.FREE: "mm free",
    Variable.ADVANCED_BY: "mm",
    Variable.SLID: "mm",
    Variable.TRAVELLED: "mm",
    Variable.HISTORY: "turns",
    Variable.TIP_ANGLE: "deg",
    Variable.TIP_RATE: "rad/s",
    Variable.TIP_DIRECTION: "-",
    Variable.TORQUE: "N mm",
    Variable.TORQUE_RATE: "N mm / s",
    Variable.PAST: "s",
    Variable.TURNED_BY: "of its unit",
    Variable.LAG: "of its unit",
    Variable.HELD_BY: "of its unit",
}
SAYS: Mapping[str, str] = {
    Variable.TRIAL_SHARE: "time",
    Variable.ACCELERATION: "rate",
    Variable.SLID_LATELY: "axial_speed",
    Variable.PUSHED_LATELY: "axial_speed",
    Variable.RESTED: "history",
    Variable.AXIAL_DRAG: "axial_speed",
    Variable.THRUST: "axial_speed",
    Variable.AXIAL_FLOW: "axial_speed",
    Variable.FREE: "depth",
    Variable.ADVANCED_BY: "axial_speed",
    Variable.SLID: "axial_speed",
    Variable.TRAVELLED: "history",
    Variable.SLID_DIRECTION: "direction",
    Variable.TIP_RATE: "rate",
    Variable.TIP_DIRECTION: "direction",
    Variable.TORQUE_RATE: "history",
    Variable.PAST: "history",
    Variable.TURNED_BY: "history",
    Variable.LAG: "rate",
    Variable.HELD_BY: "history",
}
"""What variables are called in the vocabulary, those that have no name of their own there."""
OF_THE_NEEDLE = (
    Variable.TIP_ANGLE,
    Variable.TIP_RATE,
    Variable.TIP_DIRECTION,
    Variable.TORQUE,
    Variable.TORQUE_RATE,
)
"""Variables that are known only once the needle was simulated."""
