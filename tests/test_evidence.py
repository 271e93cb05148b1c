"""What a diagnosis rests on before it fits anything: noise, base motion, thinning, limits."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from diagnosis.backdrop import Backdrop
from diagnosis.base_motion import smoothed
from diagnosis.bridging import bridged, original
from diagnosis.candidate import candidate
from diagnosis.coordinates import coordinates_of
from diagnosis.diagnose import diagnose
from diagnosis.evidence import COARSE, FINE, Evidence
from diagnosis.fit import Fit, fit_effects
from diagnosis.glance import glance
from diagnosis.held_out import surprise
from diagnosis.limits import cannot_tell, possible_effects
from diagnosis.noise import Noise, estimate_noise, white_noise
from diagnosis.nuisance import nuisance_of
from diagnosis.predict import Prediction, predict, predicted_residuals
from diagnosis.replay_error import LARGEST, replay_change, replay_error
from diagnosis.rig import NominalNeedle, NominalTissue, Rig, SensorNoise, TrialEntry
from diagnosis.rig_log import RigLog, Trial
from diagnosis.rig_model import RigModel
from diagnosis.thinning import thinned
from diagnosis.where import locate
from scipy.optimize import lsq_linear

TIP, TORQUE, BASE = 0.25, 0.01, 0.02
RIG = Rig(
    format="rig-log/1",
    needle=NominalNeedle(diameter_mm=0.59, shear_modulus_gpa=27.2, density_g_cm3=6.45),
    tissue=NominalTissue(damping_n_mm_s_per_mm=0.0172),
    sensors=SensorNoise(
        tip_angle_noise_deg=TIP, base_torque_noise_n_mm=TORQUE, base_angle_noise_deg=BASE
    ),
    trials=(TrialEntry(file="trial_01.csv"),),
)


def trial(angle, *, speed=0.0, step=0.01, name="trial_01.csv"):
    time = step * np.arange(angle.size)
    table = pd.DataFrame(
        {
            "time_s": time,
            "base_angle_deg": angle,
            "inserted_mm": 90.0,
            "free_mm": 60.0 - speed * time,
            "speed_mm_s": speed,
        }
    )
    return Trial(name=name, table=table)


def turns(seconds=12.0, step=0.01):
    time = np.arange(0, seconds, step)
    return np.interp(time, [0, 1, 1.6, 5, 5.8, 9], [0, 0, 90, 90, -30, -30])


def log_of(rig, *, seed=0, speed=0.0):
    """A log of our own needle: only for what is the same whoever made the log."""
    rng = np.random.default_rng(seed)
    clean = trial(turns(), speed=speed)
    found = predict(RIG, clean, [rig])[0]
    table = clean.table.assign(
        tip_angle_deg=found["tip_angle_deg"] + rng.normal(0, TIP, turns().size),
        base_torque_n_mm=found["base_torque_n_mm"] + rng.normal(0, TORQUE, turns().size),
    )
    return RigLog(rig=RIG, trials=(Trial(name=clean.name, table=table),))


def evidence_of(log, resolution=FINE):
    nominal = [predict(RIG, t, [RigModel()])[0] for t in log.trials]
    missed = {
        s: [t[s] - p[s] for t, p in zip(log.trials, nominal, strict=True)]
        for s in ("tip_angle_deg", "base_torque_n_mm")
    }
    noise = estimate_noise(log, missed)
    return Evidence(log=log, noise=noise, nuisance=nuisance_of(log), resolution=resolution), nominal


def test_base_noise_is_averaged_out_where_the_base_holds_and_turns_are_kept():
    angle = turns()
    noisy = angle + np.random.default_rng(1).normal(0, BASE, angle.size)
    missed = smoothed(trial(noisy), BASE) - angle
    held = slice(700, 900)  # 0.1 s and more from every corner
    # The widest window before the next corner, about 100 samples, leaves a tenth of the noise if
    # it is a mean; lines and parabolas, which are weighed in, leave up to a fifth.
    assert np.sqrt(np.mean(missed[held] ** 2)) < BASE / 5
    # Windows agree with their samples within 3 sigma, so corners are missed by no more than that.
    assert np.abs(missed).max() < 4 * BASE


def test_a_motion_that_is_never_slow_is_left_alone():
    time = np.arange(0, 10, 0.01)
    angle = 40 * np.sin(2 * np.pi * 1.5 * time) + 10 * np.sin(2 * np.pi * 3.1 * time)
    noisy = angle + np.random.default_rng(2).normal(0, BASE, angle.size)
    missed = smoothed(trial(noisy), BASE) - angle
    assert np.sqrt(np.mean(missed**2)) < BASE


@pytest.mark.parametrize("step", [0.0, 0.2, 0.35])
def test_noise_is_measured_under_a_signal_and_through_quantisation(step):
    """A quantised reading scatters by sigma and by step / sqrt(12)."""
    rng = np.random.default_rng(3)
    time = np.linspace(0, 60, 6000)
    values = 30 * np.sin(time) + rng.normal(0, 0.3, time.size)
    if step:
        values = step * np.round(values / step)
    assert white_noise([values]) == pytest.approx(np.hypot(0.3, step / np.sqrt(12)), rel=0.05)


def test_a_wrong_claim_is_named_and_the_readings_are_believed():
    log = log_of(RigModel())
    claims = RIG.sensors.but(tip_angle_noise_deg=3 * TIP)
    evidence, _ = evidence_of(RigLog(rig=RIG.but(sensors=claims), trials=log.trials))
    assert evidence.noise["tip_angle_deg"] == pytest.approx(TIP, rel=0.08)
    assert "tip_angle_deg" in evidence.noise.warnings[0]
    assert not evidence_of(log)[0].noise.warnings


@pytest.mark.parametrize(
    "rig",
    [RigModel(kinetic=0.0015), RigModel(backlash=4.0), RigModel(tissue_stiffness=0.02, tissue_time=1)],
)
def test_a_thinned_log_weighs_an_explanation_as_the_log_does(rig):
    """Sums of squares of what the nominal rig misses agree within 5 %, and truth fits both."""
    evidence, nominal = evidence_of(log_of(rig, speed=-1.0))
    coarse = thinned(evidence, nominal)
    assert coarse.resolution is COARSE
    assert len(coarse.log.trials[0].table) < 0.3 * len(evidence.log.trials[0].table)
    wrong = [
        sum(float(r[0] @ r[0]) for r in predicted_residuals(e, [RigModel()])) for e in (evidence, coarse)
    ]
    right = [sum(float(r[0] @ r[0]) for r in predicted_residuals(e, [rig])) for e in (evidence, coarse)]
    samples = [
        sum(np.isfinite(t["tip_angle_deg"]).sum() * 2 for t in e.log.trials) for e in (evidence, coarse)
    ]
    gain = [w - r for w, r in zip(wrong, right, strict=True)]
    assert gain[1] == pytest.approx(gain[0], rel=0.05)
    # A window's mean shares its outer samples with its neighbours: 0.9 of the noise is left.
    assert right[1] / samples[1] < 1.1


def test_the_replay_measures_its_own_error():
    evidence, _ = evidence_of(log_of(RigModel()))
    fine = replay_error(replay_change(evidence, RigModel(kinetic=0.002)))
    assert max(fine.values()) < LARGEST
    rough = Evidence(log=evidence.log, noise=evidence.noise, nuisance=(), resolution=COARSE)
    # Half the elements on the same samples; dry friction leaves order 1.5 of the elements: 2.8 times.
    coarse = replay_error(replay_change(rough, RigModel(kinetic=0.002)))
    assert coarse["base_torque_n_mm"] > 2 * fine["base_torque_n_mm"]


def test_a_gap_is_crossed_as_the_base_went_on_moving():
    time = np.arange(0, 6, 0.01)
    angle = 60 * np.sin(2 * np.pi * 0.5 * time)
    whole = trial(angle)
    table = whole.table.assign(tip_angle_deg=0.0)
    gap = (time > 2.3) & (time < 2.55)  # about a turning point, where a straight line is worst
    log = RigLog(rig=RIG, trials=(Trial(name="a", table=table[~gap].reset_index(drop=True)),))
    bridge = bridged(log).trials[0]
    rows = original(log.trials[0], bridge)
    assert rows.sum() == (~gap).sum()
    assert np.isnan(bridge["tip_angle_deg"][~rows]).all()
    truth = 60 * np.sin(2 * np.pi * 0.5 * bridge["time_s"])
    straight = np.interp(bridge["time_s"], log.trials[0]["time_s"], log.trials[0]["base_angle_deg"])
    # With twelve readings on both sides, 0.245 s each way, the fourth derivative leaves
    # 60 (2 pi 0.5)^4 0.245^4 / 24 = 0.9 deg at the most; a line 60 (2 pi 0.5)^2 0.25^2 / 8 = 4.6 deg.
    assert np.abs(bridge["base_angle_deg"] - truth).max() < 0.9
    assert np.abs(straight - truth).max() > 3
    assert bridged(RigLog(rig=RIG, trials=(whole,))).trials[0] is whole


def test_a_gap_is_found_where_it_was_put():
    """A tip that is off by five noises while the base holds after its second turn, and no torque."""
    rng = np.random.default_rng(3)
    motion = trial(turns())
    table = motion.table.assign(base_torque_n_mm=0.0, tip_angle_deg=0.0)
    predicted = Prediction(
        tip_angle_deg=rng.normal(0, TIP, len(table)), base_torque_n_mm=rng.normal(0, TORQUE, len(table))
    )
    off = (table["time_s"] >= 5.8) & (table["time_s"] < 9)
    predicted = replace(predicted, tip_angle_deg=predicted.tip_angle_deg + 5 * TIP * off.to_numpy())
    log = RigLog(rig=RIG, trials=(Trial(name=motion.name, table=table),))
    noise = Noise(sigma={"tip_angle_deg": TIP, "base_torque_n_mm": TORQUE, "base_angle_deg": BASE})
    found = locate(log, [predicted], noise)
    # 1 is white noise, good to 1 / sqrt(2 N) = 2 % for 1200 samples; the share of 3.2 s in 12 adds.
    assert found.signal["base_torque_n_mm"] == pytest.approx(1, abs=0.06)
    assert found.signal["tip_angle_deg"] == pytest.approx(np.sqrt(1 + 25 * 3.2 / 12), rel=0.05)
    assert found.phase["holding"] > 1.2 * found.phase["turning"]
    assert "translating" not in found.phase
    name, gap = found.worst
    assert name == "trial_01.csv, 5 to 10 s"
    assert gap == pytest.approx(np.sqrt(1 + 25 * 3.2 / 5 / 2), rel=0.05)
    bands = {low: value for low, _, value in found.band_hz}
    assert bands[0.1] > 2
    assert bands[10.0] < 1.2
    assert found.depth_mm[0][0] == 90.0


def test_an_explanation_has_to_hold_where_it_was_not_fitted():
    evidence, _ = evidence_of(log_of(RigModel(kinetic=0.001), speed=-1.0))
    two = Evidence(
        log=RigLog(rig=RIG, trials=(*evidence.log.trials, *log_of(RigModel(), seed=4).trials)),
        noise=evidence.noise,
        nuisance=evidence.nuisance,
    )
    # Friction in one trial and none in the other: no level explains both.
    torn = candidate(fit_effects(two, ("coulomb_friction",), np.array([np.log(0.001), 0, 0, 0])))
    assert surprise(torn.fit) > 9
    same = Evidence(
        log=RigLog(
            rig=RIG, trials=(*evidence.log.trials, *log_of(RigModel(kinetic=0.001), seed=5).trials)
        ),
        noise=evidence.noise,
        nuisance=evidence.nuisance,
    )
    good = candidate(fit_effects(same, ("coulomb_friction",), np.array([np.log(0.001), 0, 0, 0])))
    assert surprise(good.fit) < 9
    assert good.looked_at(same).explains
    assert not torn.looked_at(two).explains


def test_what_is_not_measured_cannot_be_told():
    log = log_of(RigModel())
    blind = RigLog(
        rig=RIG, trials=(Trial(name="a", table=log.trials[0].table.drop(columns="tip_angle_deg")),)
    )
    assert "tip_angle_bias" not in possible_effects(blind)
    assert "tip_angle_bias" in possible_effects(log)
    assert any("tip_angle_deg" in line for line in cannot_tell(blind))
    assert any("never slides" in line for line in cannot_tell(log))
    assert not any("never slides" in line for line in cannot_tell(log_of(RigModel(), speed=-1.0)))


def test_dry_friction_that_never_slides_is_undecided_and_the_next_experiment_slides():
    log = log_of(RigModel(kinetic=0.001))
    found = diagnose(log, workers=1)
    assert found.verdict.outcome == "undecided"
    assert {("coulomb_friction",), ("speed_dependent_friction",)} <= set(found.verdict.confusable)
    assert "sliding" in found.next_experiment
    assert "standard deviations apart" in found.next_experiment
    sliding = RigLog(
        rig=RIG, trials=(*log.trials, *log_of(RigModel(kinetic=0.001), speed=-2.0, seed=1).trials)
    )
    assert diagnose(sliding, workers=1).verdict.effects == ("coulomb_friction",)


def held_by_a_bound(beyond):
    """A linear rig whose third parameter is beyond its bound and looks like the first."""
    coordinates = coordinates_of(("stiction",))
    low, high = coordinates.bounds()
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
    assert best[2] == pytest.approx(high[2])
    by_trial = tuple(j @ best - y for j, y in zip(slopes, readings, strict=True))
    return Fit(
        names=("stiction",),
        coordinates=coordinates,
        x=best,
        by_trial=by_trial,
        jacobian=tuple(slopes),
        cost=float(sum(r @ r for r in by_trial)),
    )


def test_a_parameter_that_is_held_by_its_bound_holds_the_others_on_unseen_trials():
    assert surprise(held_by_a_bound(0.03)) < 3


def test_what_lies_beyond_a_bound_is_not_promised():
    """Held to the least squares of everything at once, by another algorithm."""
    fit = held_by_a_bound(2.0)
    low, high = (bound - fit.x for bound in fit.coordinates.bounds())
    slopes, residual = np.vstack(fit.jacobian), np.concatenate(fit.by_trial)
    beyond = lsq_linear(slopes, -residual).cost * 2
    assert beyond < 0.6 * fit.cost
    backdrop = Backdrop(fit, "tip_drag")
    assert backdrop.promised() == pytest.approx(fit.cost, rel=1e-3)
    for sign in (1, -1):  # an effect may be there, or not, but not be there negatively
        d = sign * np.random.default_rng(5).normal(size=residual.size) - sign * 0.3 * residual
        system = np.column_stack([slopes, d])
        room = [np.append(low - 1e-9, 0.0), np.append(high + 1e-9, np.inf)]
        least = 2 * lsq_linear(system, -residual, bounds=room, method="trf", tol=1e-12).cost
        moved = np.split(residual + d, len(fit.by_trial))
        assert backdrop.promised(moved) == pytest.approx(least, rel=1e-3)


def test_what_scatter_has_found_costs_only_its_prior_to_name():
    """A stiffness that is far off is found as scatter first; a glance at it need not move it."""
    evidence, _ = evidence_of(log_of(RigModel(stiffness_scale=1.43)))
    base = fit_effects(evidence, ())
    scale = base.parts["stiffness_error"]
    assert np.exp(scale[0]) == pytest.approx(1.43, rel=0.02)
    best = glance(evidence, base, "stiffness_error")[0]
    prior = base.coordinates.weights[base.coordinates.owners.index("stiffness_error")] * scale[0]
    assert prior**2 > 100
    # The rest of the fit is where it is for the sake of the prior too, a little.
    assert best.cost == pytest.approx(base.cost - prior**2, rel=0.01)
    assert best.start[0] == pytest.approx(scale[0])
