"""Two records of parts at once."""

from dataclasses import dataclass, field

import pytest

from diagnosis.replay.free_parts.merged import merged
from models.errors import InvalidValue


@dataclass(frozen=True, kw_only=True)
class Inner:
    one: float = 0.0
    other: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Outer:
    level: float = 1.0
    laws: tuple[str, ...] = ()
    inner: Inner = field(default_factory=Inner)


def test_each_part_is_of_the_record_that_has_it():
    assert merged(Outer(level=2.0), Outer()) == merged(Outer(), Outer(level=2.0)) == Outer(level=2.0)
    assert merged(Outer(level=2.0), Outer(level=2.0)) == Outer(level=2.0)  # no contradiction


def test_parts_of_which_there_may_be_several_are_added():
    assert merged(Outer(laws=("a",)), Outer(laws=("b",)), added=("laws",)).laws == ("a", "b")


def test_records_within_are_merged_part_by_part():
    one, other = Outer(inner=Inner(one=3.0)), Outer(inner=Inner(other=4.0))
    assert merged(one, other, within=("inner",)).inner == Inner(one=3.0, other=4.0)
    with pytest.raises(InvalidValue, match="inner"):
        merged(one, other)


def test_a_part_that_both_set_is_refused():
    with pytest.raises(InvalidValue, match="level"):
        merged(Outer(level=2.0), Outer(level=3.0))
