"""The ground truth of a log: verdict, effects, parameters, and what its trials are like."""

from dataclasses import replace

import numpy as np
import pytest

from validation.logs.alternatives import Alternatives
from validation.logs.case import draw_case
from validation.logs.ground_truth import ground_truth


@pytest.fixture(scope="module")
def case():
    """Two biases, the weaker one first."""
    names = ("tip_angle_bias", "torque_bias")
    return draw_case(np.random.default_rng(2), "pair", names, short=True, signature=(1.5, 20.0))


def test_effects_are_listed_from_the_largest_signature_down(case):
    answer = ground_truth("pair", case)
    assert answer["verdict"] == "explained"
    values = [answer["signature"][name] for name in answer["effects"]]
    assert values == sorted(values, reverse=True)
    assert answer["parameters"] == {name: dict(p) for name, p in case.rig.effects.items()}


@pytest.mark.parametrize(
    ("kind", "verdict"), [("none", "none"), ("outside", "unknown"), ("off_nominal", "explained")]
)
def test_a_kind_has_its_right_verdict(case, kind, verdict):
    assert ground_truth(kind, case)["verdict"] == verdict


def test_the_truth_of_an_effect_outside_says_what_is_missing(case):
    outside = replace(case, rig=replace(case.rig, outside={"drive_creep": {"rate": 0.1}}))
    missing = ground_truth("outside", outside)["missing"]
    assert missing == {"place": ["drive", "sensor"], "variables": ["time"]}
    assert "missing" not in ground_truth("outside", case)
    thicker = replace(case, rig=replace(case.rig, outside={"diameter_error": {"share": 0.03}}))
    assert "missing" not in ground_truth("wrong_outside", thicker)
    shorter = replace(case, rig=replace(case.rig, outside={"free_length_error": {"offset": -9.0}}))
    assert ground_truth("wrong_outside", shorter)["missing"]["place"] == ["parameters", "drive"]


def test_alternatives_are_written_where_they_were_looked_for(case):
    assert "rivals" not in ground_truth("pair", case)
    alone = {"a": 0.1, "b": 0.2, "c": 0.3, "d": 0.4}
    found = replace(case, alternatives=Alternatives(alone=alone, pair=("a", "d"), pair_residual=0.05))
    answer = ground_truth("pair", found)
    assert answer["rivals"] == {"a": 0.1, "b": 0.2, "c": 0.3}
    assert answer["rival_pair"] == ["a", "d", 0.05]


def test_every_trial_is_described(case):
    trials = ground_truth("pair", case)["details"]["trials"]
    for trial, motion in zip(trials, case.motions, strict=True):
        assert trial["duration_s"] == pytest.approx(motion.time_s[-1], abs=0.005)
        assert trial["sliding"] is bool(motion.speed_mm_s.any())
        assert trial["growing"] is motion.growing
