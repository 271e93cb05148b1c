"""A replay is made finer where, and only where, the log asks for it."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from diagnosis.candidate import candidate
from diagnosis.evidence import FINE, Evidence
from diagnosis.finer import finely_fitted
from diagnosis.fit import fit_effects
from diagnosis.noise import Noise
from diagnosis.nuisance import nuisance_of
from diagnosis.rig import NominalNeedle, NominalTissue, Rig, SensorNoise, TrialEntry
from diagnosis.rig_log import RigLog, Trial
from diagnosis.team import team
from reference_log import BETA, TIP, TORQUE
from reference_rig import Rig as ReferenceRig
from reference_rig import simulate as simulate_reference

ELASTIC = {"stiffness": 0.05, "time_constant": 0.4}


def entering(effects):
    """A needle that turns to and fro while it goes from 100 to 160 mm deep, at 3 mm/s."""
    time = np.arange(0, 20, 0.01)
    lengths = {
        "inserted_mm": 100 + 3 * time,
        "free_mm": 70 - 3 * time,
        "speed_mm_s": np.full(time.size, 3.0),
    }
    base = 240 * np.sin(2 * np.pi * 0.15 * time) ** 2
    rig = ReferenceRig(
        diameter_mm=0.59, shear_modulus_gpa=27.2, damping_n_mm_s_per_mm=BETA, effects=effects
    )
    found = simulate_reference(
        rig, time_s=time, base_angle_deg=base, cells=200, dt=5e-3, slip="material", **lengths
    )
    rng = np.random.default_rng(0)
    table = {
        "time_s": time,
        "base_angle_deg": base,
        "base_torque_n_mm": found.base_torque_n_mm + rng.normal(0, TORQUE, time.size),
        "tip_angle_deg": found.tip_angle_deg + rng.normal(0, TIP, time.size),
    }
    return Trial(name="trial_01.csv", table=pd.DataFrame(table | lengths))


def evidence_of(effects):
    rig = Rig(
        format="rig-log/1",
        needle=NominalNeedle(diameter_mm=0.59, shear_modulus_gpa=27.2, density_g_cm3=6.45),
        tissue=NominalTissue(damping_n_mm_s_per_mm=BETA),
        sensors=SensorNoise(
            tip_angle_noise_deg=TIP, base_torque_noise_n_mm=TORQUE, base_angle_noise_deg=0.01
        ),
        trials=(TrialEntry(file="trial_01.csv"),),
    )
    sigma = {"tip_angle_deg": TIP, "base_torque_n_mm": TORQUE, "base_angle_deg": 0.01}
    log = RigLog(rig=rig, trials=(entering(effects),))
    return Evidence(log=log, noise=Noise(sigma=sigma, warnings=()), nuisance=nuisance_of(log))


def fitted(evidence, effects):
    """By the usual needle, and by one as fine as the log asks."""
    with team(1) as alone:
        usual = candidate(fit_effects(evidence, tuple(effects)))
        finer, found = finely_fitted(evidence, [usual], alone)
    return usual, finer.resolution, found[0]


@pytest.mark.parametrize(
    ("effects", "asks"),
    [({"tissue_viscoelasticity": ELASTIC}, True), ({"damping_error": {"scale": 1.3}}, False)],
)
def test_a_replay_is_as_fine_as_the_log_asks(effects, asks):
    usual, resolution, found = fitted(evidence_of(effects), effects)
    assert (resolution != FINE) is asks
    assert usual.floor.reached is not asks  # a true explanation that the usual needle has to refuse
    assert found.floor.reached


def test_what_is_far_from_explained_is_not_replayed_more_finely():
    evidence = evidence_of({"tissue_viscoelasticity": ELASTIC})
    one = evidence.log.trials[0]
    ringing = one["tip_angle_deg"] + 10 * TIP * np.sin(2 * np.pi * 2.3 * one["time_s"])
    log = replace(evidence.log, trials=(replace(one, table=one.table.assign(tip_angle_deg=ringing)),))
    usual, resolution, found = fitted(replace(evidence, log=log), ["tissue_viscoelasticity"])
    assert resolution == FINE
    assert found is usual
