"""Angles along the shaft, where they have a closed form."""

import numpy as np
import pytest
from diagnosis_fixtures import RIG, log_with, trial

from diagnosis.prepare.prepare import prepare
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.replay.twist import shaft_twist

RATE_DEG_S = 10.0
DRY = RigParameters(kinetic_n_mm_per_mm=0.001)


@pytest.fixture(scope="module")
def steady():
    """A slow steady turn, at its end: every place turns at the rate of the base."""
    time = np.arange(0, 6.0, 0.02)
    log = prepare(log_with(trial(RATE_DEG_S * time, step=0.02)))[0]
    return shaft_twist(log, "trial_01.csv", 5.9, {"nominal": NOMINAL, "dry": DRY})


def test_a_steady_turn_twists_the_shaft_as_viscous_torque_does(steady):
    """kappa theta' = beta rate (l - x) in the tissue, and a straight line before it."""
    place, angle = steady.along["nominal"]
    torque = RIG.tissue.damping_n_mm_s_per_mm * np.radians(RATE_DEG_S)
    inside = np.clip(place - 60.0, 0.0, 90.0)
    expected = np.degrees(torque / RIG.rigidity_n_mm2) * (
        90.0 * np.minimum(place, 60.0) + 90.0 * inside - inside**2 / 2
    )
    np.testing.assert_allclose(angle[0] - angle, expected, atol=0.01 * expected.max())


def test_dry_friction_along_the_shaft_twists_it_further(steady):
    (_, nominal), (_, dry) = steady.along["nominal"], steady.along["dry"]
    more = nominal - dry
    assert more[0] == pytest.approx(0.0, abs=0.01)
    expected = np.degrees(0.001 / RIG.rigidity_n_mm2) * (90.0 * 60.0 + 90.0**2 / 2)
    assert more[-1] == pytest.approx(expected, rel=0.02)


def test_the_moment_is_told_with_its_lengths_and_no_reading_where_there_is_none(steady):
    assert (steady.trial, steady.at_s) == ("trial_01.csv", 5.9)
    assert (steady.free_mm, steady.inserted_mm) == (60.0, 90.0)
    assert steady.measured_tip_deg is None
    assert steady.along["nominal"][0][[0, -1]] == pytest.approx([0.0, 150.0])


def test_where_the_needle_slides_the_mesh_ends_where_the_shaft_does():
    time = np.arange(0, 3.0, 0.02)
    log = prepare(log_with(trial(RATE_DEG_S * time, step=0.02, speed=-5.0)))[0]
    found = shaft_twist(log, "trial_01.csv", 2.0, {"nominal": NOMINAL})
    assert found.free_mm == pytest.approx(70.0)
    assert found.along["nominal"][0][-1] == pytest.approx(160.0)
    assert np.all(np.diff(found.along["nominal"][0]) > 0)
