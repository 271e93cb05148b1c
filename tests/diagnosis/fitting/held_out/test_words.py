"""On which trials a residual is, in words."""

import pytest

from diagnosis.fitting.held_out.words import SEEN, UNSEEN, unseen


@pytest.mark.parametrize(("share", "said"), [(0.0, SEEN), (0.02, SEEN), (0.98, UNSEEN), (1.0, UNSEEN)])
def test_as_good_as_none_or_all_is_told_as_such(share, said):
    assert unseen(share) == said


def test_a_part_is_told_with_what_counts_for_the_rest():
    assert unseen(0.434) == (
        "on trials that the fit has not seen (43 % of the readings; of the rest no other trial tells, "
        "and the fit's own residual counts)"
    )
