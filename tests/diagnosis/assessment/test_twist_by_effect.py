"""Twist along the shaft with each effect of an explanation alone, and with all."""

import numpy as np
import pytest
from diagnosis_fixtures import log_of

from diagnosis.assessment import twist_by_effect as module
from diagnosis.assessment.twist_by_effect import twist_by_effect
from diagnosis.fitting.fit import fit_effects
from diagnosis.nominal_replay import replay_nominal
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.candidate import candidate
from sim.needles.run import SimulationFailed

MOMENT = ("trial_01.csv", 3.0)
EFFECTS = ("coulomb_friction", "tip_angle_bias")


@pytest.fixture(scope="module")
def problem():
    return replay_nominal(log_of(NOMINAL, seconds=4.0)).problem


@pytest.fixture(scope="module")
def near(problem):
    """An explanation by friction and an offset of the tip's reading, both strong."""
    parts = {"coulomb_friction": np.array([np.log(0.002)]), "tip_angle_bias": np.array([1.0])}
    start = problem.parameterization(EFFECTS).joined(parts)
    return candidate(fit_effects(problem, EFFECTS, start, most_iterations=0))


def test_friction_twists_the_shaft_and_an_offset_of_a_reading_does_not(problem, near):
    twist = twist_by_effect(problem, near, EFFECTS, MOMENT)
    assert [*twist.along] == ["nominal", *EFFECTS, "explained"]
    tip = {name: own[1, -1] for name, own in twist.along.items()}
    assert tip["tip_angle_bias"] == pytest.approx(tip["nominal"], abs=1e-6)
    assert abs(tip["coulomb_friction"] - tip["nominal"]) > 0.1
    assert tip["explained"] == pytest.approx(tip["coulomb_friction"], abs=1e-6)


def test_of_one_effect_alone_is_all(problem, near):
    twist = twist_by_effect(problem, near, EFFECTS[:1], MOMENT)
    assert [*twist.along] == ["nominal", "explained"]


def test_where_a_rig_cannot_be_simulated_there_is_none(problem, near, monkeypatch):
    def failing(*_):
        raise SimulationFailed("lost its numbers")

    monkeypatch.setattr(module, "shaft_twist", failing)
    assert twist_by_effect(problem, near, EFFECTS, MOMENT) is None


def test_after_a_stop_there_is_none(problem, near, monkeypatch):
    monkeypatch.setattr(module, "stopping", lambda: True)
    assert twist_by_effect(problem, near, EFFECTS, MOMENT) is None
