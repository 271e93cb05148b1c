"""Runs of the simulated needle through estimators, for tests of the controllers."""

import numpy as np

from controllers.signals import Sample
from sim.experiment import perform
from sim.paper_protocols import protocol_named

BETA = 0.01725333


def viscous_run(name, *, step_s, rest_s=None):
    """A protocol of the paper in viscous tissue; `rest_s` shortens its last segment."""
    made = protocol_named(name)
    *first, last = made.segments
    rest = (
        last
        if rest_s is None
        else last.but(duration_s=rest_s, advance_mm=last.advance_mm * rest_s / last.duration_s)
    )
    cut = made.discretisation.but(step_s=step_s, elements=32)
    return perform(made.but(tissue="viscous-plastisol", discretisation=cut, segments=(*first, rest)))


def estimates(recording, estimator, *, tip=False):
    """The estimate at every sample of a recording; with `tip` the estimator sees the tip too."""
    names = ("time_s", "base_angle_deg", "base_torque_n_mm", "inserted_mm", "free_mm")
    rows = zip(*(recording[n] for n in names), recording["tip_angle_deg"], strict=True)
    return [estimator.update(Sample(*row[:5], row[5] if tip else None)) for row in rows]


def worst(recording, found):
    """Largest error of estimated tips, deg."""
    tip = np.array([e.tip_deg for e in found])
    return float(np.abs(tip - recording["tip_angle_deg"]).max())
