"""The effect that docs/architecture.md adds in one file works as the page says."""

from dataclasses import replace
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from diagnosis.assessment.uncertainty.intervals import covariance, intervals
from diagnosis.effects import LIBRARY
from diagnosis.fitting.fit import fit_effects
from diagnosis.fitting.nuisance import nuisance_of
from diagnosis.fitting.parameterization import parameterization_of, starts
from diagnosis.fitting.problem import FitProblem
from diagnosis.log.nominal_rig import NominalRig
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.prepare.prepared_log import PreparedLog, PreparedTrial
from diagnosis.replay.accuracy.numerical_error import refinement_change
from diagnosis.replay.replay import predict, replay
from diagnosis.replay.resolution import Resolution

PAGE = Path(__file__).parents[2] / "docs" / "architecture.md"
TRUTH = {"level": 0.001, "exponent": 0.8}
NOISE = Noise(sigma={"tip_angle_deg": 0.3, "base_torque_n_mm": 0.01, "base_angle_deg": 0.0})
TRUE_RESOLUTION = Resolution(elements=24, step_s=0.01)  # twice the elements of the fit


@pytest.fixture
def effect(monkeypatch):
    """The effect of the page, in the library as its file would put it there."""
    block = PAGE.read_text().split("```python\n")[1].split("```")[0]
    module = ModuleType("example")
    exec(compile(block, str(PAGE), "exec"), module.__dict__)
    monkeypatch.setitem(LIBRARY, module.EFFECT.name, module.EFFECT)
    return module.EFFECT


def rig():
    return NominalRig(
        format="rig-log/1",
        needle={"diameter_mm": 0.59, "shear_modulus_gpa": 27.2, "density_g_cm3": 6.45},
        tissue={"damping_n_mm_s_per_mm": 0.0172},
        sensors={"tip_angle_noise_deg": 0.3, "base_torque_noise_n_mm": 0.01, "base_angle_noise_deg": 0},
        trials=[{"file": "trial_01.csv"}],
    )


def trial(depth_mm, rate_deg_s):
    """A turn of 90 deg, a hold, and half of it back."""
    time = np.arange(0.0, 6.0, 0.02)
    turned = 0.5 + 90.0 / rate_deg_s
    base = np.interp(time, [0.5, turned, 4.5, 4.5 + 45.0 / rate_deg_s], [0.0, 90.0, 90.0, 45.0])
    return PreparedTrial(
        name="trial_01.csv",
        time_s=time,
        base_motion_deg=base,
        inserted_mm=np.full(time.size, depth_mm),
        free_mm=np.full(time.size, 60.0),
        speed_mm_s=np.zeros(time.size),
        tip_torque_n_mm=None,
        readings={},
        logged=np.ones(time.size, bool),
    )


def measured(bare, truth, rng):
    """The trial with what the sensors of the true rig read."""
    prediction = predict(rig(), bare, [truth], TRUE_RESOLUTION)[0]
    readings = {
        sensor: prediction[sensor] + rng.normal(0.0, NOISE[sensor], bare.time_s.size)
        for sensor in ("tip_angle_deg", "base_torque_n_mm")
    }
    return replace(bare, readings=readings)


def problem_of(effect):
    truth = effect.apply(parameterization_of(()).rig(np.zeros(0)), **TRUTH)
    rng = np.random.default_rng(3)
    trials = tuple(measured(trial(*own), truth, rng) for own in ((60.0, 200.0), (100.0, 60.0)))
    log = PreparedLog(rig=rig(), trials=trials)
    return FitProblem(log=log, noise=NOISE, nuisance=nuisance_of(log))


def test_a_fit_recovers_the_parameters_of_the_example_effect_within_their_intervals(effect):
    problem = problem_of(effect)
    start = parameterization_of((effect.name,), problem.nuisance).joined(
        {effect.name: starts(effect)[0]}
    )
    fit = fit_effects(problem, (effect.name,), start)
    best = fit.parameterization.rig(fit.x)
    change = refinement_change(
        problem.log, problem.noise, best, replay(problem.log, best), problem.resolution
    )
    found = intervals(fit, covariance(problem, fit, change))[effect.name]
    for name, value in TRUTH.items():
        assert found[name].low <= value <= found[name].high, name
        # Narrow enough to exclude that the effect is absent.
        assert found[name].high - found[name].low < 0.1 * value, name
