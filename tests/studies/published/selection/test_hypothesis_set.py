"""Which hypotheses are fitted."""

import pytest
from reference_fits import fit_with

from diagnosis.effects import LIBRARY
from studies.published.experiments.rig import WITH_FREE_LENGTH, WITHOUT_FREE_LENGTH
from studies.published.fitting.mechanisms import NOT_STUDIED
from studies.published.selection.hypothesis_set import ALL_HYPOTHESES, SUSPECTS, pairs, singles

STUDIED = set(LIBRARY) - NOT_STUDIED


@pytest.fixture
def alone():
    return [fit_with(h.names, 3.0, base=h.base, parameters=2) for h in singles()]


def test_every_mechanism_is_fitted_alone_after_the_damping():
    names = [h.names[0] for h in singles() if h.base == WITH_FREE_LENGTH]
    assert names[0] == "damping_error"
    assert set(names) == {*STUDIED, "free_length", "base_ramp", "base_servo"}
    without = [h.names[0] for h in singles() if h.base == WITHOUT_FREE_LENGTH]
    assert set(without) == {"damping_error", *SUSPECTS} - {"free_length"}


def test_no_pair_has_two_motions_of_the_base_or_a_free_length_where_there_is_none(alone):
    for pair in pairs(alone):
        assert not {"base_ramp", "base_servo"} <= set(pair.names)
        assert pair.base.free_mm > 0 or "free_length" not in pair.names
        assert len(set(pair.names)) == 2


def test_the_leading_mechanism_is_joined_by_what_improves_on_the_damping(alone):
    leading = fit_with(("base_servo",), 1.0, base=WITHOUT_FREE_LENGTH, parameters=2)
    better = fit_with(("layered_tissue",), 2.0, base=WITH_FREE_LENGTH, parameters=2)
    found = {(p.base, p.names) for p in pairs([*alone, leading, better])}
    assert (WITHOUT_FREE_LENGTH, ("base_servo", "layered_tissue")) in found
    assert (WITHOUT_FREE_LENGTH, ("base_servo", "torque_bias")) not in found


def test_gelatin_gets_every_effect_alone():
    assert {h.names for h in ALL_HYPOTHESES.gelatin} == {(name,) for name in STUDIED}
    assert [h.names for h in ALL_HYPOTHESES.plastisol] == [h.names for h in singles()]
