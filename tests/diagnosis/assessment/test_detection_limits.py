"""Detection limits: beside a closed form, and on rigs that have the effect."""

import math
from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import coarse_of, concluded, log_of, start_of_search
from reference_log import TIP, make_log

from diagnosis.assessment.detection_limits import detection_limit, detection_limits
from diagnosis.criteria.fitting import SCATTER
from diagnosis.effects import LIBRARY
from diagnosis.fitting.fit import fit_effects
from diagnosis.log.rig_log import read_rig_log
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.search import search
from diagnosis.selection.verdicts.verdict import VerdictKind
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed

# All that dry friction along the shaft could be taken for.
FRICTION = (
    "coulomb_friction",
    "stiction",
    "speed_dependent_friction",
    "shear_thinning",
    "entry_friction",
    "sheath_friction",
)


def test_a_bias_goes_unseen_below_its_closed_form(nothing):
    """A constant b in N readings takes N (b / noise)^2 off the cost, less what a fit takes back.

    Stiffness, damping and slip take back less than half of it where the base turns both ways.
    """
    samples = sum(int(np.isfinite(t["tip_angle_deg"]).sum()) for t in nothing.log.trials)
    asked = math.log(2 * samples) + 2 * math.log(len(LIBRARY)) + 10
    least = TIP * (math.sqrt(asked) + 1.645) / math.sqrt(samples)
    limit = nothing.found.assessment.detection_limits["tip_angle_bias"].parameters["bias"]
    assert nothing.found.verdict.kind is VerdictKind.NONE
    assert 0.97 * least < limit < 1.5 * least


def test_no_limit_is_given_of_what_trials_cannot_show(nothing):
    limits = nothing.found.assessment.detection_limits
    assert "load_dependent_friction" not in limits  # a log without tip_torque_n_mm
    assert not set(SCATTER) & set(limits)  # open in every fit


@pytest.mark.parametrize(("share", "seen"), [(0.4, False), (1.6, True)])
def test_what_is_stronger_than_its_limit_is_seen(nothing, tmp_path, share, seen):
    """At the limit 5 % go unseen.

    1.6 of it is 4 standard deviations above, 0.4 is 2.4 below what is asked.
    """
    level = share * nothing.found.assessment.detection_limits["coulomb_friction"].parameters["level"]
    folder = make_log(tmp_path / "log", {"coulomb_friction": {"level": level}}, seed=11)
    found = search(start_of_search(read_rig_log(folder), FRICTION), Workers())
    assert ("coulomb_friction" in concluded(found).effects) is seen


@pytest.fixture(scope="module")
def still():
    """A small decimated log with nothing unmodelled, and its fit."""
    coarse = coarse_of(log_of(NOMINAL, seconds=6.0))
    return coarse, fit_effects(coarse, ())


def test_at_the_limit_an_effect_changes_what_is_asked(still):
    """Half the strength of a bias changes half of it: the limit does not hang on the start."""
    coarse, fit = still
    _, limit = detection_limit(coarse, fit, fit, "tip_angle_bias")
    # 1200 readings at 100 a second, averaged by 4: as many in the cost as the decimated log has.
    tips = np.isfinite(coarse.log.trials[0].readings["tip_angle_deg"]).sum()
    asked = math.log(fit.samples) + 2 * math.log(len(LIBRARY)) + 10
    least = coarse.noise["tip_angle_deg"] * (math.sqrt(asked) + 1.645) / math.sqrt(tips)
    assert 0.97 * least < limit.parameters["bias"] < 1.5 * least


def test_what_would_have_to_be_beyond_its_range_has_no_limit(still):
    """The range ends at half of what would be seen: whatever is there goes unseen."""
    coarse, fit = still
    _, limit = detection_limit(coarse, fit, fit, "tip_angle_bias")
    bias = LIBRARY["tip_angle_bias"]
    (own,) = bias.parameters
    for end in (0.5, 0.95, 1.05):
        high = end * limit.parameters["bias"]
        short = replace(bias, parameters=(replace(own, low=-high, high=high, start=(0.1 * high,)),))
        within = replace(coarse, library={**coarse.library, "tip_angle_bias": short})
        _, found = detection_limit(within, fit, fit, "tip_angle_bias")
        assert (found.parameters != {}) is (end > 1.0)


def test_an_effect_that_cannot_be_simulated_has_no_limit_and_the_others_do(still):
    def failing(*_):
        raise SimulationFailed("lost its numbers")

    coarse, fit = still
    lost = replace(LIBRARY["tip_drag"], apply=failing)
    coarse = replace(coarse, library={**coarse.library, "tip_drag": lost})
    limits = detection_limits(coarse, fit, fit, ("tip_drag", "torque_bias"), Workers())
    assert set(limits) == {"torque_bias"}


def test_beside_two_effects_nothing_further_is_told(still):
    coarse, _ = still
    two = fit_effects(coarse, ("tip_angle_bias", "torque_bias"), most_iterations=1)
    assert detection_limits(coarse, two, two, ("tip_drag",), Workers()) == {}
