"""A rig of a posterior in a motion: the needle of a replay, driven as its encoder says."""

import numpy as np
import pytest

from diagnosis.replay.rig_parameters import NOMINAL
from sim.simulation import simulate
from studies.campaign.campaign import read_campaign
from studies.campaign.posterior.drawn_rig import drawn_rig, times_s, tip_error_deg


def run_of(drawn):
    return simulate([drawn.setup()], drawn.schedule())[0]


@pytest.fixture
def campaign(posterior_file):
    return read_campaign(posterior_file())


def test_without_parameters_it_is_the_nominal_rig_in_viscous_tissue(campaign):
    setup = drawn_rig(campaign.posterior, campaign.base, {}).setup()
    assert setup.tissue.layers[0].interface.viscous_n_mm_s_per_mm == 0.0172
    assert setup.needle.diameter_mm == 0.59
    assert setup.discretisation.elements == campaign.base.discretisation.elements
    assert drawn_rig(campaign.posterior, campaign.base, {}).rig == NOMINAL


def test_the_tip_error_is_what_the_tip_lacks_of_what_the_base_is_sent_to(campaign):
    drawn = drawn_rig(campaign.posterior, campaign.base, {"coulomb_friction.level": 0.002})
    run = run_of(drawn)
    error = tip_error_deg(drawn, run)
    assert error.shape == times_s(campaign.base).shape
    assert error[0] == 0.0
    assert error[-1] == pytest.approx(60.0 - run.tip_deg[-1], abs=1e-9)


def test_an_encoder_that_reads_too_much_leaves_the_tip_short(campaign):
    """The shaft turns by 60 / 1.25 deg: after a long hold, 12 deg are missing."""
    held = campaign.base.but(segments=({"duration_s": 0.2, "turn_deg": 60}, {"duration_s": 30.0}))
    drawn = drawn_rig(campaign.posterior, held, {"base_angle_scale.scale": 1.25})
    assert tip_error_deg(drawn, run_of(drawn))[-1] == pytest.approx(12.0, abs=1e-3)


def test_sensors_of_the_tip_do_not_move_it(campaign):
    known, motion = campaign.posterior, campaign.base
    plain, biased = (drawn_rig(known, motion, values) for values in ({}, {"tip_angle_bias.bias": 5.0}))
    np.testing.assert_array_equal(
        tip_error_deg(plain, run_of(plain)), tip_error_deg(biased, run_of(biased))
    )
