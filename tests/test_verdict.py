"""What is concluded from candidates whose scores are given."""

import numpy as np
import pytest
from diagnosis.candidate import Candidate
from diagnosis.coordinates import coordinates_of, starts
from diagnosis.fit import Fit
from diagnosis.verdict import Outcome, judge
from diagnosis.whiteness import Floor

from diagnosis.effects import LIBRARY

AT_FLOOR = Floor(gap=1.0, slow=1.0)


def scored(names, score):
    coordinates = coordinates_of(names)
    x = coordinates.joined({n: starts(LIBRARY[n])[0] for n in names})
    fit = Fit(
        names=tuple(names),
        coordinates=coordinates,
        x=x,
        by_trial=(np.zeros(10),),
        jacobian=(np.zeros((10, x.size)),),
        cost=0.0,
    )
    return Candidate(fit=fit, score=score, floor=AT_FLOOR, unseen=AT_FLOOR)


def verdict_on(*each):
    return judge(sorted((scored(*one) for one in each), key=lambda c: c.score))


@pytest.mark.parametrize(
    ("lead", "outcome", "effects"),
    [
        (8, Outcome.EXPLAINED, ("stiction",)),
        (3, Outcome.UNDECIDED, ("coulomb_friction",)),
        (-3, Outcome.UNDECIDED, ("coulomb_friction",)),
        (-8, Outcome.UNDECIDED, ("coulomb_friction",)),
        (-12, Outcome.EXPLAINED, ("coulomb_friction",)),
    ],
)
def test_an_effect_and_one_that_contains_it_are_told_apart_by_their_scores(lead, outcome, effects):
    found = verdict_on((["coulomb_friction"], 100.0), (["stiction"], 100.0 - lead))
    assert (found.outcome, found.effects) == (outcome, effects)
    if outcome is Outcome.UNDECIDED:
        assert set(found.confusable) == {("coulomb_friction",), ("stiction",)}


@pytest.mark.parametrize(("lead", "outcome"), [(8, Outcome.UNDECIDED), (12, Outcome.EXPLAINED)])
def test_unrelated_effects_are_told_apart_by_more(lead, outcome):
    found = verdict_on((["tip_drag"], 100.0), (["entry_friction"], 100.0 + lead))
    assert found.outcome is outcome
    assert found.effects == ("tip_drag",)


def test_a_second_effect_has_to_lead_the_first_alone():
    near = verdict_on((["tip_drag"], 108.0), (["tip_drag", "torque_bias"], 100.0))
    assert (near.outcome, near.effects) == (Outcome.EXPLAINED, ("tip_drag",))
    far = verdict_on((["tip_drag"], 112.0), (["tip_drag", "torque_bias"], 100.0))
    assert set(far.effects) == {"tip_drag", "torque_bias"}


def test_a_richer_form_with_a_second_effect_is_held_to_the_wider_margin():
    near = verdict_on((["coulomb_friction"], 108.0), (["stiction", "torque_bias"], 100.0))
    assert (near.outcome, near.effects) == (Outcome.EXPLAINED, ("coulomb_friction",))
    far = verdict_on((["coulomb_friction"], 112.0), (["stiction", "torque_bias"], 100.0))
    assert set(far.effects) == {"stiction", "torque_bias"}
