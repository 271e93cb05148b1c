"""Tables IV and V: every depth and free length, with the baselines first."""

import math

import pytest

from studies.control import tables


@pytest.fixture(scope="module")
def calls():
    """What is compared, without simulating it."""
    asked = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tables, "compare", lambda tissue, **how: asked.append((tissue, how)) or [how])
        made = tables.tables_iv_v()
    return asked, made


def test_every_depth_is_turned_with_both_free_lengths(calls):
    asked, made = calls
    assert [(how["depth_cm"], how["free_mm"]) for how in made] == [
        (depth, free) for depth in (5.0, 10.0, 20.0) for free in (0.0, 50.0)
    ]
    assert {tissue.name for tissue, _ in asked} == {"viscous-plastisol"}


def test_the_base_alone_under_the_same_limits_is_the_first_row_of_every_comparison(calls):
    for _, how in calls[0]:
        assert how["controllers"][:2] == ("base_only_at_limit", "base_only")
        assert math.isclose(how["design"].damping_n_mm_s_per_mm, tables.DAMPING)
