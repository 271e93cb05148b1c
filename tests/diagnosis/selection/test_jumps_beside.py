"""Lost counts beside an explanation."""

import pytest
from lossy_logs import AT, LOST_DEG, NAMES, read

from diagnosis.fitting.fit import fit_effects
from diagnosis.nominal_replay import replay_nominal
from diagnosis.prepare.motion.base_jumps import small_jumps
from diagnosis.selection.jumps_beside import jumps_beside, shifted_back
from diagnosis.workers import Workers


def found_beside(log):
    """The jumps, and the share of what dry friction leaves beyond noise that they take off."""
    problem = replay_nominal(log).problem
    fit = fit_effects(problem, NAMES)
    jumps, taken_off = jumps_beside(fit, shifted_back(problem, fit, small_jumps(log), Workers()))
    return jumps, taken_off / max(fit.cost - fit.samples, 1.0)


def test_counts_that_an_effect_hides_are_found_with_their_size():
    """The tip tells the size by the mean of hundreds of readings, far better than the encoder."""
    (jump,), share = found_beside(read(LOST_DEG))
    assert (jump.number, jump.sample) == (1, AT)
    assert jump.size_deg == pytest.approx(LOST_DEG, abs=0.1)
    assert share > 0.5


@pytest.mark.parametrize("turned_deg", [0.0, LOST_DEG], ids=["steady", "turned"])
def test_what_the_encoder_has_not_lost_is_not_found(turned_deg):
    """Neither scatter of the encoder, nor a step that the shaft has made."""
    jumps, share = found_beside(read(turned_deg=turned_deg))
    assert jumps == []
    assert share == 0.0


def test_where_nothing_jumps_nothing_is_replayed():
    log = read(LOST_DEG)
    problem = replay_nominal(log).problem
    fit = fit_effects(problem, NAMES)
    assert shifted_back(problem, fit, [], Workers()) == []
    assert jumps_beside(fit, []) == ([], 0.0)


def test_a_jump_changes_the_trial_that_it_is_in_from_its_time_on():
    log = read(LOST_DEG)
    problem = replay_nominal(log).problem
    fit = fit_effects(problem, NAMES)
    for own in shifted_back(problem, fit, small_jumps(log), Workers()):
        there, other = own.change[own.jump.number], own.change[1 - own.jump.number]
        assert not other.any()
        assert not there[: own.jump.sample - 1].any()  # of the torque, which comes first
        assert there[own.jump.sample :].any()
