"""The published experiments on the MuJoCo needle."""

import math

import numpy as np
import pytest

from diagnosis.replay.rig_parameters import RigParameters
from models.modes import InsertedNeedle, ramp
from models.needle import NITINOL
from studies.crosscheck.paper import integral_deg_s
from studies.published.experiments import replay as replay_module
from studies.published.experiments.base_turn import BaseTurn, BaseTurnShape
from studies.published.experiments.figures import plastisol
from studies.published.experiments.read_off import interpolated_settling_s
from studies.published.experiments.replay import FigureReplay
from studies.published.experiments.rig import WITHOUT_FREE_LENGTH, PublishedRig

BETA = 3.45 / 200


@pytest.mark.parametrize("depth_mm", [50.0, 100.0])
def test_the_stated_model_gives_what_the_closed_form_gives(depth_mm):
    time = np.arange(0.0, 4.0, 1e-3)
    needle = InsertedNeedle(needle=NITINOL, damping_n_mm_s_per_mm=BETA, inserted_mm=depth_mm)
    exact = needle.respond(time, ramp(time, by=math.radians(90), duration_s=0.3))
    error = 90 - np.degrees(exact.tip_rad)
    figures = [f for f in plastisol() if f.depth_mm == depth_mm]
    damping, settled, integral = FigureReplay()(figures, [WITHOUT_FREE_LENGTH])[:, 0]
    # The discretisation is within a twentieth of every standard deviation (criteria.ELEMENTS).
    assert damping == pytest.approx(BETA * depth_mm, abs=figures[0].sigma / 20)
    assert settled == pytest.approx(interpolated_settling_s(time, error), abs=figures[1].sigma / 20)
    assert integral == pytest.approx(integral_deg_s(time, error), abs=figures[2].sigma / 20)


def test_the_replay_is_fine_enough_where_the_tissue_is_not_linear():
    servo = BaseTurn(shape=BaseTurnShape.SERVO, time_s=0.11)
    rigs = [
        PublishedRig(model=RigParameters(shared_n_mm_per_mm=8e-4, damping_scale=0.4), turn=servo),
        PublishedRig(model=RigParameters(kinetic_n_mm_per_mm=1e-3, damping_scale=0.3)),
        PublishedRig(model=RigParameters(rate_exponent=0.65, damping_scale=0.4)),
        PublishedRig(
            model=RigParameters(tissue_stiffness_n_mm_per_rad_per_mm=0.004, tissue_time_constant_s=1.3)
        ),
    ]
    coarse = FigureReplay()(plastisol(), rigs)
    fine = FigureReplay(elements=12, refinement=4)(plastisol(), rigs)
    sigma = np.array([f.sigma for f in plastisol()])
    assert np.abs((coarse - fine).T / sigma).max() < 0.05


def test_no_needle_is_simulated_twice_and_a_slow_turn_ignores_the_base_motion(monkeypatch):
    simulated = []

    def simulate(setups, inputs):
        simulated.extend(setups)
        return original(setups, inputs)

    original = replay_module.simulate
    monkeypatch.setattr(replay_module, "simulate", simulate)
    replay, slow = FigureReplay(), plastisol()[:1]
    rigs = [PublishedRig(), PublishedRig(), PublishedRig(free_mm=0.0, turn=BaseTurn(time_s=0.1))]
    first = replay(slow, rigs)
    assert np.array_equal(first, replay(slow, rigs))
    assert np.ptp(first) == 0.0
    assert len(simulated) == 1
    assert replay.unconverged(rigs[0]) == 0
