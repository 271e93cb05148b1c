"""Small logs of our own needle, problems and fits: for what is the same whoever made the log."""

from dataclasses import replace

import numpy as np
import pandas as pd
from scipy.optimize import lsq_linear

from diagnosis.assessment.identifiability import testable_effects
from diagnosis.effects import FITTED, LIBRARY
from diagnosis.fitting.decimation import decimated
from diagnosis.fitting.fit import Fit, nominal_fit
from diagnosis.fitting.fit_status import FitStatus, Termination
from diagnosis.fitting.noise_floor import NoiseFloor
from diagnosis.fitting.nuisance import nuisance_of
from diagnosis.fitting.parameterization import parameterization_of, starts
from diagnosis.fitting.problem import FitProblem
from diagnosis.log.nominal_rig import (
    NominalNeedle,
    NominalRig,
    NominalTissue,
    SensorNoise,
    TrialEntry,
)
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import Trial
from diagnosis.nominal_replay import nominal_residuals, replay_nominal
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.prepare.prepare import prepare
from diagnosis.prepare.prepared_log import PreparedLog
from diagnosis.replay.replay import predict
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.checked import check
from diagnosis.selection.state import SearchState
from diagnosis.selection.verdicts.decision import verdict_on
from diagnosis.workers import Workers

TIP, TORQUE, BASE = 0.25, 0.01, 0.02
RIG = NominalRig(
    format="rig-log/1",
    needle=NominalNeedle(diameter_mm=0.59, shear_modulus_gpa=27.2, density_g_cm3=6.45),
    tissue=NominalTissue(damping_n_mm_s_per_mm=0.0172),
    sensors=SensorNoise(
        tip_angle_noise_deg=TIP, base_torque_noise_n_mm=TORQUE, base_angle_noise_deg=BASE
    ),
    trials=(TrialEntry(file="trial_01.csv"),),
)
NOISE = Noise(sigma={"tip_angle_deg": TIP, "base_torque_n_mm": TORQUE, "base_angle_deg": BASE})
ENDED = FitStatus(termination=Termination.GRADIENT, message="converged after 1 iteration")
AT_FLOOR = NoiseFloor(gap=1.0, slow=1.0)


def trial(angle, *, speed=0.0, step=0.01, name="trial_01.csv", deep_mm=90.0):
    """A trial without readings."""
    time = step * np.arange(angle.size)
    table = pd.DataFrame(
        {
            "time_s": time,
            "base_angle_deg": angle,
            "inserted_mm": deep_mm,
            "free_mm": 60.0 - speed * time,
            "speed_mm_s": speed,
        }
    )
    return Trial(name=name, table=table)


def turns(seconds=12.0, step=0.01):
    """A fast turn, and back past the start."""
    time = np.arange(0, seconds, step)
    return np.interp(time, [0, 1, 1.6, 5, 5.8, 9], [0, 0, 90, 90, -30, -30])


def log_with(*trials, rig=RIG):
    """A log of these trials."""
    return RigLog(rig=rig, trials=trials)


def prepared(one):
    """A trial, ready for replay."""
    return prepare(log_with(one))[0].trials[0]


def log_of(rig, *, seed=0, speed=0.0, seconds=12.0, deep_mm=90.0, angle=None):
    """A log of one trial, of our own needle; its base turns fast, and rests, but for another angle."""
    rng = np.random.default_rng(seed)
    clean = trial(turns(seconds) if angle is None else angle, speed=speed, deep_mm=deep_mm)
    found = predict(RIG, prepared(clean), [rig])[0]
    size = len(clean.table)
    table = clean.table.assign(
        tip_angle_deg=found["tip_angle_deg"] + rng.normal(0, TIP, size),
        base_torque_n_mm=found["base_torque_n_mm"] + rng.normal(0, TORQUE, size),
    )
    return log_with(Trial(name=clean.name, table=table))


def joined(*logs):
    """The trials of several logs in one."""
    trials = [replace(t, name=f"trial_{i + 1:02d}.csv") for i, t in enumerate(_trials(logs))]
    return log_with(*trials)


def _trials(logs):
    return [trial for log in logs for trial in log.trials]


def problem_of(log, *, sigma=None):
    """A log as a problem to fit; its noise estimated, or as given."""
    if sigma is None:
        return replay_nominal(log).problem
    ready, _ = prepare(log)
    return FitProblem(log=ready, noise=Noise(sigma=sigma), nuisance=nuisance_of(ready))


def coarse_of(log):
    """A log as a decimated problem."""
    nominal = replay_nominal(log)
    return decimated(nominal.problem, nominal.predictions)


FITTED_SAMPLES = 1000
"""Residuals of each fit of the fixture `made`."""
NO_LOG = FitProblem(log=PreparedLog(rig=None, trials=()), noise=None, nuisance=())
"""A problem for fits that nobody makes."""


def fit_of(names, *, by_trial=None, jacobian=None, x=None, nuisance=(), cost=None, status=ENDED):
    """A fit that nobody made: by default at the first start, with residuals of 0."""
    parameterization = parameterization_of(names, nuisance)
    first = {n: starts(FITTED[n])[0] for n in names}
    x = parameterization.joined(first) if x is None else np.asarray(x, float)
    by_trial = [np.asarray(r, float) for r in ([np.zeros(10)] if by_trial is None else by_trial)]
    if jacobian is None:
        jacobian = tuple(np.zeros((r.size, x.size)) for r in by_trial)
    prior = parameterization.weights * x
    own = sum(float(r @ r) for r in by_trial) + float(prior @ prior)
    return Fit(
        names=tuple(names),
        parameterization=parameterization,
        x=x,
        by_trial=tuple(by_trial),
        jacobian=tuple(np.asarray(slopes, float) for slopes in jacobian),
        cost=own if cost is None else cost,
        status=status,
    )


def scored(names, score, **known):
    """A candidate at the noise floor, of a fit that nobody made."""
    floors = {"floor": AT_FLOOR, "held_out": (np.zeros(10),), "held_out_floor": AT_FLOOR}
    return Candidate(fit=fit_of(names), score=score, **(floors | known))


def held_by_a_bound(beyond):
    """The fit of a linear rig whose third parameter is beyond its bound and looks like the first."""
    low, high = parameterization_of(("stiction",)).bounds()
    rng = np.random.default_rng(4)
    slopes, readings = [], []
    true = 0.5 * (low + high)
    true[2] = high[2] + beyond
    for _ in range(4):
        columns = rng.normal(size=(500, 3))
        columns[:, 2] = -columns[:, 0] + 0.05 * columns[:, 2]
        slopes.append(10 * columns)
        readings.append(slopes[-1] @ true + rng.normal(size=500))
    best = lsq_linear(np.vstack(slopes), np.concatenate(readings), bounds=(low, high)).x
    assert abs(best[2] - high[2]) < 1e-6
    by_trial = [j @ best - y for j, y in zip(slopes, readings, strict=True)]
    return fit_of(("stiction",), by_trial=by_trial, jacobian=slopes, x=best)


def start_of_search(log, effects=None):
    """Where a search begins, among all effects that a log can show or among some."""
    nominal = replay_nominal(log)
    problem = nominal.problem
    return SearchState(
        problem=problem,
        coarse=decimated(problem, nominal.predictions),
        effects=testable_effects(log) if effects is None else effects,
        nominal=nominal_fit(nominal_residuals(problem, nominal.predictions)),
    )


def concluded(state):
    """The verdict on what a search has come to."""
    return verdict_on(check(state.problem, state.candidates, state.checked).candidates)


def sets_screened(stage, state, monkeypatch, *, explained):
    """The sets that a stage of the search screens, where a log is explained already or not."""
    monkeypatch.setattr(SearchState, "rechecked", lambda own: (own, explained))
    asked = []

    def screen_all(_, calls, __):
        asked.extend((*base.names, name) for _, base, name in calls)
        return [], ()

    monkeypatch.setitem(stage.__globals__, "screen_all", screen_all)
    stage(state, Workers())
    return asked


def verdict_of(*each):
    """The verdict on candidates at the noise floor, by names and score."""
    return verdict_on(sorted((scored(*one) for one in each), key=lambda c: c.score))


def held(names, score):
    """A candidate of which one parameter stopped at a bound."""
    one = scored(names, score)
    (effect,) = names
    bound = f"{effect}.{LIBRARY[effect].reported[0].name}"
    return replace(one, fit=replace(one.fit, status=replace(one.fit.status, at_bound=(bound,))))


def concluding(found, **verdict):
    """A diagnosis with another verdict."""
    return replace(found, verdict=replace(found.verdict, **verdict))
