"""Free-form families, fits and logs without a simulation: readings are linear in coordinates."""

from dataclasses import fields, replace
from functools import cache

import numpy as np
from diagnosis_fixtures import ENDED, NOISE, RIG, log_with, prepared, trial

from diagnosis.assessment.assessment import Assessment
from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.nuisance import nuisance_of
from diagnosis.fitting.parameterization import Parameterization
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.family import Family, coordinates_of
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.law_curve import Law
from diagnosis.freeform.missing.missing import Dependence, Missing
from diagnosis.freeform.ranges import ranges_of
from diagnosis.freeform.smooth_curve import smooth_curve
from diagnosis.log.trial import SENSORS
from diagnosis.prepare.prepare import prepare
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.replay import predict
from diagnosis.replay.resolution import COARSE

VOCABULARY = {
    *("time", "event", "base_angle", "tip_angle", "rate", "direction", "axial_speed", "depth"),
    *("torque", "position", "history"),
}
"""Variables that a report may name (rig-log/1, what a report adds)."""
LEVEL = Parameter(name="level", unit="-", low=-50.0, high=50.0, start=(0.0,))
CURVE = smooth_curve(0.0, 1.0, 8)


def family_of(
    parameters=None, *, says="time", places=None, name="free", curve=None, title="damping", unit="-"
):
    """A family whose law is the smooth curve of `CURVE`, by default."""
    places = places or {Place.INTERFACE: 1.0}
    return Family(
        effect=Effect(
            name=name,
            title=name,
            place=max(places, key=lambda place: places[place]),
            parameters=coordinates_of(CURVE) if parameters is None else tuple(parameters),
            apply=lambda rig, *_: rig,
        ),
        places=places,
        says=says,
        title=title,
        curve=curve or (lambda *c: (CURVE.places, CURVE.values(c))),
        x_unit="s",
        unit=unit,
    )


def priors(family):
    """Standard deviations of its coordinates before the fit."""
    return np.array([p.prior_sigma for p in family.effect.parameters])


def solved(slopes, readings, sigma):
    """The coordinates that are most probable, by the normal equations of ridge regression."""
    rows, values = np.vstack(slopes), np.concatenate(readings)
    return np.linalg.solve(rows.T @ rows + np.diag(1.0 / sigma**2), rows.T @ values)


def linear_fit(family, slopes, readings, x=None, beside=()):
    """The fit of a family to readings that its coordinates change by `slopes`, trial by trial."""
    x = solved(slopes, readings, priors(family)) if x is None else np.asarray(x, float)
    by_trial = tuple(j @ x - y for j, y in zip(slopes, readings, strict=True))
    own = Parameterization(effects=(family.effect, *beside), nuisance=())
    return Fit(
        names=(family.name,),
        parameterization=own,
        x=x,
        by_trial=by_trial,
        jacobian=tuple(slopes),
        cost=sum(float(r @ r) for r in by_trial) + float(np.sum((own.weights * x) ** 2)),
        status=ENDED,
    )


def free_fit(gap_after, *, final=True, freedom=1, **family):
    """A fit that nobody made, whose data determine so many coordinates."""
    levels = [replace(LEVEL, name=f"level {i}") for i in range(freedom)]
    own = family_of(parameters=levels, curve=lambda *c: ((0.0,), (sum(c),)), **family)
    fit = linear_fit(own, [np.eye(freedom)], [np.zeros(freedom)])
    return FreeFit(family=own, fit=fit, gap_after=gap_after, final=final)


LAW = Law(
    place=Place.INTERFACE,
    variable="rate",
    title="friction along the shaft",
    x_unit="rad/s",
    unit="N mm / mm",
    x=(0.01, 0.1, 1.0),
    y=(0.001, 0.002, 0.004),
    low=(0.0009, 0.0019, 0.0035),
    high=(0.0011, 0.0021, 0.0045),
)


def missing_with(law=LAW, **changes):
    """What a report may say, of no log at all."""
    others = (p for p in Place if p is not Place.INTERFACE)
    given = {
        "place": {Place.INTERFACE: 0.9, **dict.fromkeys(others, 0.02)},
        "depends_on": (
            Dependence(variable="rate", gap_after=1.03, title="friction", place=Place.INTERFACE),
            Dependence(variable="time", gap_after=2.5, title="damping", place=Place.INTERFACE),
            Dependence(variable="torque", gap_after=np.inf, title="error", place=Place.SENSOR),
        ),
        "law": law,
        "best": free_fit(1.03, says="rate"),
        "closed": law is not None,
    }
    return Missing(**(given | changes))


def nothing_told(**known):
    """An assessment that says nothing but this."""
    return Assessment(**({field.name: None for field in fields(Assessment)} | known))


def covered(angle, *, tip=None, torque=None, speed=0.0, seen=None):
    """Ranges of a log of one trial, whose nominal rig reads `seen` (tip, torque): by default nothing.

    Args:
      tip, torque: readings, (N,); None: not read.
    """
    return ranges_of(*one_trial(angle, tip=tip, torque=torque, speed=speed, seen=seen))


def covered_by(trials, softer=()):
    """Ranges of a log of several trials: the angle, the tip's readings, and what the nominal rig reads.

    Args:
      softer: what one with less damping reads, (tip, torque) each.
    """
    tables = [
        replace(own, table=own.table.assign(tip_angle_deg=tip))
        for i, (angle, tip, _) in enumerate(trials)
        for own in [trial(np.asarray(angle, float), name=f"trial_{i + 1:02d}.csv")]
    ]
    ready = prepare(log_with(*tables))[0]
    problem = FitProblem(log=ready, noise=NOISE, nuisance=nuisance_of(ready))
    return ranges_of(
        problem, [_prediction(*seen) for _, _, seen in trials], [_prediction(*own) for own in softer]
    )


def _prediction(tip_deg, torque_n_mm):
    return Prediction(tip_angle_deg=tip_deg, base_torque_n_mm=torque_n_mm)


def one_trial(angle, *, tip=None, torque=None, speed=0.0, seen=None):
    """A problem of one trial, and what its nominal rig reads."""
    clean = trial(np.asarray(angle, float), speed=speed)
    read = {"tip_angle_deg": tip, "base_torque_n_mm": torque}
    table = clean.table.assign(**{name: own for name, own in read.items() if own is not None})
    ready = prepare(log_with(replace(clean, table=table)))[0]
    problem = FitProblem(log=ready, noise=NOISE, nuisance=nuisance_of(ready))
    size = ready.trials[0].time_s.size
    return problem, [_prediction(*(seen or (np.zeros(size), np.zeros(size))))]


DAMPING = RIG.tissue.damping_n_mm_s_per_mm


def same_readings(angle, one, other, *, mirrored=False, within=1e-6):
    """Whether two rigs read the same of a turn, to a share of what is read.

    Args:
      angle: of the base every 10 ms; every fourth is turned.
      mirrored: whether the other one is turned the other way, and its readings are.
    """
    sign = -1.0 if mirrored else 1.0
    first, second = _read(tuple(angle[::4]), one), _read(tuple(sign * angle[::4]), other)
    return all(
        np.allclose(first[s], sign * second[s], rtol=0, atol=within * np.ptp(first[s])) for s in SENSORS
    )


@cache
def _read(angle, rig):
    return predict(RIG, prepared(trial(np.array(angle), step=0.04)), [rig], COARSE)[0]


def fits_of_four():
    return [
        free_fit(1.02, name="direction", says="direction", places={Place.INTERFACE: 1.0}),
        free_fit(1.2, name="tip", says="torque", places={Place.SENSOR: 0.6, Place.NEEDLE: 0.4}),
        free_fit(3.0, name="time", says="time", places={Place.TISSUE: 1.0}),
        free_fit(3.5, name="other time", says="time", places={Place.INTERFACE: 1.0}),
    ]


def beside_another(gap=1.1):
    """The fit of a law in the tissue, over time, with another along the shaft, over the rate."""
    one = free_fit(gap, says="time", places={Place.TISSUE: 1.0})
    level = replace(LEVEL, name="level 0")
    other = family_of(parameters=[level], curve=lambda v: ((0.0,), (v,)), says="rate", name="other")
    fit = linear_fit(one.family, [np.eye(2)], [np.zeros(2)], x=[2.0, 7.0], beside=(other.effect,))
    return replace(one, fit=fit, others=(other,))


def fitted_curve(truth, rng, noise=1.0):
    """A curve fitted to 60 readings at random places of it, and noise."""
    family = family_of(name="curve", says="depth", places={Place.SENSOR: 1.0})
    at = rng.uniform(0, 1, 60)
    slopes = np.stack([np.interp(at, CURVE.places, column) for column in CURVE.basis.T], axis=1)
    readings = slopes @ truth + rng.normal(0, noise, at.size)
    fit = linear_fit(family, [slopes], [readings])
    return FreeFit(family=family, fit=fit, gap_after=1.0, final=True)
