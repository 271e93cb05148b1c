"""Free-form laws to save, and a diagnosis that found one."""

from dataclasses import replace

import numpy as np
from diagnosis_fixtures import fit_of

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.effects.saved.effect_file import SavedEffect
from diagnosis.fitting.parameterization import Parameterization
from diagnosis.freeform.family import Family
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.law_curve import Law
from diagnosis.freeform.missing.missing import Dependence, Missing
from diagnosis.replay.along_depth import AlongDepth
from diagnosis.replay.curve import ActsOn, Course, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.free_parts.free_coupling import FreeCoupling
from diagnosis.replay.free_parts.free_grip import FreeGrip
from diagnosis.replay.free_parts.free_play import FreePlay
from diagnosis.replay.free_parts.free_shaft import FreeShaft
from diagnosis.replay.variables import Variable
from models.kerf import Kerf
from models.tissue import Interface

OVER_DEPTH = Curve(
    acts_on=ActsOn.TISSUE, variable=Variable.DEPTH, places=(0.0, 40.0, 80.0), values=(0.5, 1.0, 3.0)
)
STICKY = FreeLaw(throughout=(Interface(kinetic_n_mm_per_mm=0.001, varies=True),), curves=(OVER_DEPTH,))
"""Dry friction that grows with the inserted length."""
GROWING = Curve(
    acts_on=ActsOn.DRIVE_ANGLE,
    variable=Variable.TURNED_BY,
    places=(1.0, 3.0),
    values=(-0.5, -0.2),
    factor=Course(variable=Variable.TIME, places=(0.0, 20.0), values=(0.3, 1.7)),
)
"""Lost motion that grows in time."""
EVERYTHING = replace(
    STICKY,
    curves=(OVER_DEPTH, GROWING),
    tissue_varies=True,
    stiffness_varies=True,
    viscosity_exponent=0.3,
    flows_at_deg=25.0,
    asymmetry=-0.2,
    rate_curve=(0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.4, 1.6, 1.8, 2.0),
    rate_range_rad_s=(0.1, 2.0),
    along_depth=AlongDepth(damping=(1.0, 2.0), thicknesses_mm=(30.0,)),
    shaft=FreeShaft(
        stiffness_along=(1.0, 0.8, 1.0),
        stiffness_along_mm=150.0,
        creep_ratio=0.3,
        creep_time_s=2.0,
        damping_time_s=0.1,
    ),
    coupling=FreeCoupling(stiffness_n_mm_per_rad=5.0, unwinding_ratio=0.5),
    grip=FreeGrip(torque_n_mm=0.5, play_deg=3.0, stiffness_n_mm_per_rad=1.0),
    from_start=(Interface(orientation_n_mm_per_mm=0.01, orientation_cycles=0.1),),
    at_tip=(Interface(viscous_n_mm_s_per_mm=0.1),),
    plays=(FreePlay(trial="trial_01.csv", play_deg=2.0, from_s=3.0, over_s=0.1),),
    kerfs=(Kerf(torque_n_mm=0.1, travel_mm=5.0),),
)
"""A law that uses every field."""
SOFTENING = FreeLaw(
    tissue_varies=True,
    curves=(replace(OVER_DEPTH, acts_on=ActsOn.STIFFNESS, variable=Variable.TRIAL_SHARE),),
)
"""A shaft whose stiffness follows the share of a trial that has passed."""


def saved(law=STICKY, name="sticky_membrane", **changes):
    """What a file would hold of a law."""
    title = "dry friction that changes with depth"
    return SavedEffect(
        **({"name": name, "title": title, "place": Place.INTERFACE, "law": law} | changes)
    )


def missing_with(
    free=STICKY, *, place=Place.INTERFACE, variable="depth", closed=True, curve=True, **rig
):
    """What is missing of a log, if the best of all free laws is this one.

    Args:
      curve: whether it leaves less than the library does.
      rig: what else of a rig the law changes.
    """
    effect = Effect(
        name="a free law",
        title="dry friction that changes with depth",
        place=place,
        parameters=(Parameter(name="straight 0", unit="-", low=-1.0, high=1.0, start=(0.0,)),),
        apply=lambda own, _: replace(own, free=free, **rig),
    )
    fit = replace(
        fit_of(()), x=np.zeros(1), parameterization=Parameterization(effects=(effect,), nuisance=())
    )
    family = Family(
        effect=effect,
        places={place: 1.0},
        says=variable,
        title="dry friction along the shaft",
        curve=lambda _: ((0.0, 1.0), (0.0, 1.0)),
        x_unit="mm",
        unit="N mm / mm",
    )
    points = {
        "x": (0.0, 40.0, 80.0),
        "y": (0.5, 1.0, 3.0),
        "low": (0.4, 0.9, 2.9),
        "high": (0.6, 1.1, 3.1),
    }
    told = Law(
        place=place, variable=variable, title=family.title, x_unit="mm", unit="N mm / mm", **points
    )
    return Missing(
        place={own: 1.0 if own is place else 0.0 for own in Place},
        depends_on=(Dependence(variable=variable, gap_after=1.01, title=family.title, place=place),),
        law=told if curve else None,
        best=FreeFit(family=family, fit=fit, gap_after=1.01, final=True),
        closed=closed,
    )
