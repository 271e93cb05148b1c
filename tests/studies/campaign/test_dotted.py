"""Dotted paths into plain data."""

import pytest

from models.errors import InvalidValue
from studies.campaign.dotted import replaced

CONTENT = {"tissue": {"layers": [{"depth": 1}, {"depth": 2}]}, "free_mm": 50}


def test_one_value_is_replaced_in_a_copy():
    found = replaced(CONTENT, "tissue.layers.1.depth", 5)
    assert found == {"tissue": {"layers": [{"depth": 1}, {"depth": 5}]}, "free_mm": 50}
    assert CONTENT["tissue"]["layers"][1]["depth"] == 2


def test_a_whole_branch_may_be_replaced():
    assert replaced(CONTENT, "tissue", "chicken") == {"tissue": "chicken", "free_mm": 50}


@pytest.mark.parametrize(
    ("path", "said"),
    [
        ("tisue.layers", "did you mean 'tissue'"),
        ("tissue.layers.2.depth", "a position from 0 to 1"),
        ("tissue.layers.x", "a position from 0 to 1"),
        ("free_mm.more", "the value 50"),
        ("", "one of tissue, free_mm"),
    ],
)
def test_a_path_to_nothing_says_what_there_is(path, said):
    with pytest.raises(InvalidValue, match=said) as error:
        replaced(CONTENT, path, 1)
    assert error.value.field == f"vary.{path}"
