"""Pairs are tried where no effect alone explains the log, or where a second promises enough."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import fit_of, scored

from diagnosis.criteria.selection import SECOND_LEAVES, WORTH_FITTING
from diagnosis.selection.record import Decision
from diagnosis.selection.screening import Screened
from diagnosis.selection.stages import pairs as module
from diagnosis.selection.stages.nominal_rig import nominal_rig
from diagnosis.selection.stages.pairs import pairs
from diagnosis.selection.stages.single_effects import single_effects
from diagnosis.selection.stages.stage import taking_off_enough
from diagnosis.workers import Workers


def promised(cost, gain):
    return Screened(names=("tip_drag", "torque_bias"), start=np.zeros(2), cost=cost, gain=gain)


@pytest.mark.parametrize(
    ("alone", "one", "worth"),
    [
        (False, promised(900.0, WORTH_FITTING), True),
        (False, promised(900.0, 0.9 * WORTH_FITTING), False),
        (True, promised(0.98 * SECOND_LEAVES * 1000.0, 0.0), True),
        (True, promised(1.001 * SECOND_LEAVES * 1000.0, 500.0), False),
    ],
)
def test_beside_an_effect_that_explains_the_log_a_second_has_to_promise_more(
    alone, one, worth, still_start
):
    by_trial = [np.full(1000, 1.0)]
    first = replace(scored(["tip_drag"], 1.0), fit=fit_of(("tip_drag",), by_trial=by_trial))
    state = replace(still_start, singles=(first,))
    assert module._worth_a_second(one, state, alone=alone) is worth


def test_a_second_effect_has_to_take_off_the_log_itself_what_it_promised(still_start):
    def costing(names, cost):
        return replace(scored(names, 1.0), fit=fit_of(names, cost=cost))

    first = costing(("tip_drag",), 1000.0)
    state = replace(still_start, singles=(first,), candidates=(first,))
    pair = ("tip_drag", "torque_bias")
    asked = (1 - SECOND_LEAVES) * 1000.0
    found = [costing(pair, 1000.0 - share * asked) for share in (0.9, 1.1)]
    enough, (out,) = taking_off_enough("pairs", (found, ()), 1000.0, state)
    assert enough == found[1:]
    assert (out.effects, out.decision) == (pair, Decision.DROPPED)


@pytest.mark.slow
def test_beside_dry_friction_alone_no_pair_is_fitted(dry_start):
    begun = single_effects(nominal_rig(dry_start, Workers()), Workers())
    found = pairs(begun, Workers())
    assert found.pairs == ()
    tried = {e.effects for e in found.record if len(e.effects) == 2}
    assert tried == {("coulomb_friction", other) for other in ("tip_drag", "torque_bias")}
