"""Free law of tissue that relaxes: viscoelastic, with any spectrum of relaxation times.

Beside the viscous torque, whose size is free, the tissue holds the shaft by Maxwell branches, each a
spring k in series with a damper k tau: after a turn its torque falls by exp(-t / tau). Many branches
make any linear viscoelastic law, such as a power of time; Kelvin-Voigt tissue behind viscous friction
is one branch.
"""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from models.tissue import Interface

TIMES_S = (0.1, 0.4, 1.6, 6.4, 25.6)
"""Relaxation times, a factor of four apart: between them, two branches together relax alike."""
_START = 0.1  # of the stiffness of yielding tissue, which stands in series
_LEAST = 1e-9  # of a branch that is as good as none, in N mm / rad / mm


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law, if anything turns."""
    stiffness = ranges.library["tissue_viscoelasticity"].parameters[0]
    start = _START * stiffness.start[0]
    branch = replace(stiffness, low=0.0, start=(start,), scale=start, logarithmic=False, neutral=0.0)
    damping = Parameter(
        name="damping", unit="-", low=0.02, high=5.0, start=(1.0,), logarithmic=True, neutral=1.0
    )
    branches = (replace(branch, name=f"stiffness {i}") for i in range(len(TIMES_S)))
    law = Family(
        effect=Effect(
            name="elastic tissue over relaxation",
            title="tissue that relaxes at several rates",
            place=Place.TISSUE,
            parameters=(damping, *branches),
            apply=_apply,
        ),
        places={Place.TISSUE: 0.7, Place.INTERFACE: 0.3},
        says="history",
        title="stiffness of the tissue that relaxes",
        curve=_spectrum,
        x_unit="s of relaxation time",
        unit="N mm / rad / mm",
        contains=("tissue_viscoelasticity",),
    )
    return (law,)


def _spectrum(_: float, *stiffness: float) -> Points:
    return TIMES_S, stiffness


def _apply(rig: RigParameters, damping: float, *stiffness: float) -> RigParameters:
    branches = tuple(
        _branch(max(k, _LEAST), time_s) for k, time_s in zip(stiffness, TIMES_S, strict=True)
    )
    viscous = Curve(
        acts_on=ActsOn.TISSUE, variable=Variable.TIME, places=(0.0, 1.0), values=(damping, damping)
    )
    return replace(rig, free=FreeLaw(tissue_varies=True, curves=(viscous,), throughout=branches))


def _branch(stiffness: float, time_s: float) -> Interface:
    return Interface(viscous_n_mm_s_per_mm=stiffness * time_s, stiffness_n_mm_per_rad_per_mm=stiffness)
