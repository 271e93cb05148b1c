"""What is never known exactly of a rig, and is left open in every fit.

Stiffness and damping scatter by a few per cent about the nominal. And where the
needle slides while it is twisted, it is open which rate the tissue resists: the spatial derivative at
a fixed place, as in the paper's equation (9), or the material derivative of the shaft that slides past;
for trials of constant depth and of growing depth apart.
"""

from dataclasses import replace

from diagnosis.criteria import SCATTER, SLIDING_MM_S
from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.prepare.prepared_log import PreparedLog
from diagnosis.replay.rig_parameters import RigParameters
from sim.discretisation import Mesh

# A share between 0 and 1 is as good as open with this standard deviation.
CONVENTIONS = {"slip_constant_depth": 0.5, "slip_growing_depth": 0.5}
PRIOR_SIGMA = SCATTER | CONVENTIONS


def _constant_depth(rig: RigParameters, share: float) -> RigParameters:
    return replace(rig, material_share_constant_depth=share)


def _growing_depth(rig: RigParameters, share: float) -> RigParameters:
    return replace(rig, material_share_growing_depth=share)


_SHARE = Parameter(name="share", unit="-", low=0.0, high=1.0, start=(0.0,))
SLIP_CONSTANT_DEPTH = Effect(
    name="slip_constant_depth",
    title="the rate that the tissue resists, at constant depth",
    place=Place.INTERFACE,
    parameters=(_SHARE,),
    apply=_constant_depth,
)
SLIP_GROWING_DEPTH = Effect(
    name="slip_growing_depth",
    title="the rate that the tissue resists, at growing depth",
    place=Place.INTERFACE,
    parameters=(_SHARE,),
    apply=_growing_depth,
)


def nuisance_of(log: PreparedLog) -> tuple[Effect, ...]:
    """What every fit of a log leaves open."""
    sliding = [trial for trial in log.trials if (abs(trial.speed_mm_s) > SLIDING_MM_S).any()]
    growing = [trial.schedule.mesh is Mesh.LAGRANGIAN for trial in sliding]
    slips = [SLIP_CONSTANT_DEPTH] if not all(growing) else []
    slips += [SLIP_GROWING_DEPTH] if any(growing) else []
    return (*(LIBRARY[name] for name in SCATTER), *slips)
