"""Recordings: without a roughness they are those of plain sensors; every roughness changes its part."""

import numpy as np
import pytest

from validation.logs.motions import draw_motions, draw_plan
from validation.logs.roughness.recording import INCOMPATIBLE, PAIRS, ROUGHNESSES
from validation.logs.roughness.roughness import Roughness
from validation.logs.sensors import BASE, TIP, TORQUE, measure
from validation.rig.unmodelled.effect import IdealSignals


def test_there_are_ten_roughnesses_and_all_their_pairs_but_one():
    assert len(ROUGHNESSES) == 10
    assert len(PAIRS) == 45 - len(INCOMPATIBLE)
    assert all(len({*pair}) == 2 and {*pair} not in INCOMPATIBLE for pair in PAIRS)


def test_a_recording_without_roughness_is_that_of_plain_sensors(recorded, drive, sensors):
    motion = drive(lambda time_s: 0 * time_s, dt=0.01, end=100.0)
    zero = np.zeros(motion.time_s.size)
    ideal = IdealSignals(
        time_s=motion.time_s, base_deg=zero, torque_n_mm=zero, tip_deg=zero, speed_mm_s=zero
    )
    plain = measure(np.random.default_rng(0), sensors, motion, ideal)
    (rough,) = recorded()
    assert list(rough) == list(plain)
    assert all(rough[name] == pytest.approx(plain[name], abs=1e-12) for name in plain)


def test_a_roughness_changes_nothing_by_default(recorded):
    (same,) = recorded(Roughness(name="none", numbers={}))
    (plain,) = recorded()
    assert all((same[name] == plain[name]).all() for name in plain)


@pytest.mark.parametrize("name", ROUGHNESSES)
def test_every_roughness_names_itself_and_changes_a_log(recorded, name):
    """Two of them before anything is sampled: the plan of a log, or its motions."""
    rng = np.random.default_rng(5)
    one = ROUGHNESSES[name](rng)
    assert one.name == name
    assert one.numbers
    plan = draw_plan(rng, short=True, slides=False, loads=False)
    motions = draw_motions(rng, plan)
    tones = {n: lambda t: 50 * np.sin(3 * t) for n in ("tip_deg", "torque_n_mm")}
    (rough,), (plain,) = recorded(one, **tones), recorded(**tones)
    same = rough["time_s"].size == plain["time_s"].size and all(
        (rough[column] == plain[column]).all() for column in ("time_s", BASE, TIP, TORQUE)
    )
    assert same is (name in ("sampling_rate", "late_start"))
    assert (one.plan(plan) != plan) is (name == "sampling_rate")
    assert (one.motions(rng, motions) is not motions) is (name == "late_start")


def test_a_load_is_recorded_too(recorded):
    (columns,) = recorded(load=lambda time_s: 0.01 * time_s)
    assert columns["tip_torque_n_mm"][-1] == pytest.approx(1.0)


@pytest.mark.parametrize("pair", PAIRS)
def test_every_pair_can_be_recorded_together(recorded, pair):
    one = [ROUGHNESSES[name](np.random.default_rng(2)) for name in pair]
    (columns,) = recorded(*one)
    assert (np.diff(columns["time_s"]) > 0).all()
    assert len({values.size for values in columns.values()}) == 1
    assert all(np.isfinite(values).all() for values in columns.values())
