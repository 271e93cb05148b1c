"""What messages share."""

from diagnosis.log.checks.wording import listed


def test_four_names_are_listed_and_the_others_counted():
    assert listed(["a", "b"]) == "a, b"
    assert listed({name: 1.0 for name in "abcdef"}) == "a, b, c, d and 2 more"
