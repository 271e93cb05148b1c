"""What every fit leaves open."""

from dataclasses import replace

import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns

from diagnosis.criteria import SCATTER
from diagnosis.fitting.nuisance import CONVENTIONS, PRIOR_SIGMA, nuisance_of
from diagnosis.prepare.prepared_log import PreparedLog
from diagnosis.replay.rig_parameters import NOMINAL

STILL = prepared(trial(turns()))
SLIDING = prepared(trial(turns(), speed=-1.0))
GROWING = replace(SLIDING, inserted_mm=90 + SLIDING.time_s)
CONSTANT, GROWS = "slip_constant_depth", "slip_growing_depth"


@pytest.mark.parametrize(
    ("trials", "slips"),
    [
        ((STILL,), set()),
        ((STILL, SLIDING), {CONSTANT}),
        ((GROWING,), {GROWS}),
        ((SLIDING, GROWING), {CONSTANT, GROWS}),
    ],
)
def test_scatter_is_open_always_and_the_rate_by_what_a_log_does(trials, slips):
    names = {e.name for e in nuisance_of(PreparedLog(rig=RIG, trials=trials))}
    assert names == set(SCATTER) | slips


def test_each_open_share_is_of_its_own_kind_of_trial():
    log = PreparedLog(rig=RIG, trials=(SLIDING, GROWING))
    shares = {e.name: e.apply(NOMINAL, 0.7) for e in nuisance_of(log) if e.name in CONVENTIONS}
    assert shares[CONSTANT] == replace(NOMINAL, material_share_constant_depth=0.7)
    assert shares[GROWS] == replace(NOMINAL, material_share_growing_depth=0.7)


def test_everything_that_is_open_has_a_prior():
    log = PreparedLog(rig=RIG, trials=(SLIDING, GROWING))
    assert {e.name for e in nuisance_of(log)} == set(PRIOR_SIGMA)
