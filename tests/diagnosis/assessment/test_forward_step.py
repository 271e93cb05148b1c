"""What each further effect would add."""

from dataclasses import replace

import pytest
from diagnosis_fixtures import log_of

from diagnosis.assessment.forward_step import (
    forward_selection,
    further_effects,
    gap_with_one_more,
    on_decimated,
)
from diagnosis.effects import LIBRARY
from diagnosis.fitting.decimation import decimated
from diagnosis.fitting.fit import fit_effects
from diagnosis.nominal_replay import replay_nominal
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed

EFFECTS = ("torque_bias", "coulomb_friction", "tip_drag")


@pytest.fixture(scope="module")
def dry_log():
    """A log with dry friction: its scatter fitted, and the same on the decimated log."""
    nominal = replay_nominal(log_of(RigParameters(kinetic_n_mm_per_mm=0.001), seconds=8.0))
    coarse = decimated(nominal.problem, nominal.predictions)
    best = fit_effects(nominal.problem, ())
    return coarse, best, on_decimated(coarse, best)


def test_the_best_fit_is_about_as_good_on_the_decimated_log(dry_log):
    _, best, base = dry_log
    assert base.names == best.names
    assert base.samples < 0.3 * best.samples
    # Sums of squares of the decimated log agree with those of the log within 5 %.
    assert base.cost == pytest.approx(best.cost, rel=0.05)


def test_what_the_log_has_would_add_most(dry_log):
    coarse, best, base = dry_log
    further = further_effects(coarse, best, EFFECTS, Workers())
    assert further.base.cost == base.cost
    left = gap_with_one_more(best.gap, further)
    assert list(left) == sorted(left, key=lambda name: left[name])
    assert next(iter(left)) == "coulomb_friction"
    assert left["coulomb_friction"] < 0.5 * best.gap
    assert all(gap <= 1.001 * best.gap for gap in left.values())


def test_what_cannot_be_simulated_adds_nothing(dry_log):
    def failing(*_):
        raise SimulationFailed("lost its numbers")

    coarse, best, _ = dry_log
    lost = replace(LIBRARY["tip_drag"], apply=failing)
    coarse = replace(coarse, library={**coarse.library, "tip_drag": lost})
    found = gap_with_one_more(best.gap, further_effects(coarse, best, EFFECTS, Workers()))
    assert set(found) == set(EFFECTS) - {"tip_drag"}


@pytest.fixture(scope="module")
def many():
    """A log with dry friction, an offset of the torque and a tip that shows too much, and less."""
    rig = RigParameters(kinetic_n_mm_per_mm=0.001, torque_bias_n_mm=0.1, tip_scale=1.2)
    nominal = replay_nominal(log_of(rig, seconds=8.0))
    problem = nominal.problem
    coarse = decimated(problem, nominal.predictions)
    start = problem.parameterization(("coulomb_friction",)).joined({"coulomb_friction": [-7.0]})
    return problem, coarse, fit_effects(problem, ("coulomb_friction",), start)


FOUR = ("torque_bias", "coulomb_friction", "tip_drag", "tip_angle_scale")


@pytest.mark.slow
def test_effects_are_added_while_each_takes_off_a_good_share_but_not_down_to_the_noise(many):
    problem, coarse, best = many
    further = further_effects(coarse, best, FOUR, Workers())
    found = forward_selection(problem, coarse, best, further, FOUR, Workers())
    assert len(found.names) == 2
    assert found.names[0] == "coulomb_friction"
    assert found.names[1] in {"torque_bias", "tip_angle_scale"}
    assert found.cost < 0.8 * best.cost
    assert found.gap > 1.1  # three would explain it: that is not told as what comes nearest


def test_where_no_effect_takes_off_much_the_fit_stays_as_it_is(dry_log):
    """Negative control: next to the whole truth there is nothing to add."""
    coarse, best, _ = dry_log
    further = further_effects(coarse, best, ("tip_drag",), Workers())
    assert forward_selection(coarse, coarse, best, further, ("tip_drag",), Workers()) is best
