"""The size of a rig: the same rig in other units of torque has the same answer."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import log_of

from diagnosis.effects import FITTED, library_of
from diagnosis.fitting.fit import fit_effects
from diagnosis.log.nominal_rig import NominalRig
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import Trial
from diagnosis.nominal_replay import replay_nominal
from diagnosis.prepare.prepare import prepare
from diagnosis.prepare.rig_scale import RigScale, scale_of
from diagnosis.replay.rig_parameters import RigParameters

DRY = RigParameters(kinetic_n_mm_per_mm=0.001)


def in_other_units(log: RigLog, factor: float) -> RigLog:
    """All torques so many times larger: stiffness, damping, torque sensor and readings."""
    rig = log.rig.model_dump()
    rig["needle"]["shear_modulus_gpa"] *= factor
    rig["tissue"]["damping_n_mm_s_per_mm"] *= factor
    rig["sensors"]["base_torque_noise_n_mm"] *= factor
    trials = []
    for trial in log.trials:
        table = trial.table.copy()
        table["base_torque_n_mm"] *= factor
        trials.append(Trial(name=trial.name, table=table))
    return replace(log, rig=NominalRig(**rig), trials=tuple(trials))


@pytest.fixture(scope="module")
def log():
    return log_of(DRY, speed=-1.0, seconds=6.0)


def test_the_papers_needle_has_the_bounds_of_the_library(log):
    scale = scale_of(prepare(log)[0])
    assert scale.torque_scale == pytest.approx(1.0, rel=1e-6)
    assert scale.rate_scale == 1.0
    own = library_of(RigScale())
    assert {n: e.parameters for n, e in own.items()} == {n: e.parameters for n, e in FITTED.items()}


@pytest.mark.parametrize("factor", [0.02, 30.0])
def test_torques_so_many_times_larger_make_a_rig_so_many_times_larger(log, factor):
    here, there = (scale_of(prepare(one)[0]) for one in (log, in_other_units(log, factor)))
    assert there.torque_scale == pytest.approx(factor * here.torque_scale)
    assert there.rate_scale == here.rate_scale
    assert there.dry_n_mm_per_mm == pytest.approx(factor * here.dry_n_mm_per_mm)


def test_bounds_and_starts_with_a_unit_of_torque_grow_and_others_stay():
    own = library_of(RigScale(torque_scale=10.0, rate_scale=3.0))
    level, stribeck = own["stiction"].parameters[0], own["stiction"].parameters[2]
    known = FITTED["stiction"].parameters
    assert (level.low, level.high) == pytest.approx((10 * known[0].low, 10 * known[0].high))
    assert level.start == pytest.approx([10 * value for value in known[0].start])
    assert stribeck.high == pytest.approx(3 * known[2].high)
    assert own["chuck_backlash"].parameters == FITTED["chuck_backlash"].parameters
    assert own["torque_bias"].parameters[0].scale == pytest.approx(0.5)


def test_a_dry_level_that_holds_all_measured_torque_is_within_bounds():
    own = library_of(RigScale(dry_n_mm_per_mm=2.0))
    assert own["coulomb_friction"].parameters[0].high == 2.0
    assert own["entry_friction"].parameters[0].high == FITTED["entry_friction"].parameters[0].high


def test_an_inserted_offset_leaves_a_tenth_of_the_shallowest_trial_inserted(log):
    shallowest = scale_of(prepare(log)[0]).shallowest_mm
    assert shallowest == 90.0
    own = library_of(RigScale(shallowest_mm=4.0))["inserted_offset"].parameters[0]
    assert own.low == pytest.approx(-3.6)
    assert own.start == pytest.approx(2 * (5.0, -1.8))
    deep = library_of(RigScale(shallowest_mm=shallowest))["inserted_offset"].parameters
    assert deep == FITTED["inserted_offset"].parameters


@pytest.mark.slow
def test_a_fit_in_other_units_of_torque_comes_to_the_same_answer(log):
    found = []
    for one in (log, in_other_units(log, 0.02)):
        problem = replay_nominal(one).problem
        start = problem.parameterization(("coulomb_friction",)).joined(
            {"coulomb_friction": np.log([problem.library["coulomb_friction"].parameters[0].start[0]])}
        )
        fit = fit_effects(problem, ("coulomb_friction",), start)
        found.append((fit.gap, fit.parameterization.values(fit.x)[0]))
    (gap, level), (other_gap, other_level) = found
    assert level == pytest.approx(0.001, rel=0.05)
    # Inertia, which has no unit of torque of its own here, takes 1e-6 of it.
    assert other_gap == pytest.approx(gap, rel=1e-4)
    assert other_level == pytest.approx(0.02 * level, rel=1e-3)
