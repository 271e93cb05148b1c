"""What a diagnosis concludes."""

from diagnosis_fixtures import fit_of

from diagnosis.selection.candidate import candidate
from diagnosis.selection.verdicts.verdict import distinct, places


def test_sets_that_cannot_be_told_apart_are_named_once_each():
    sets = [("tip_drag", "stiction"), ("stiction", "tip_drag"), (), ("tip_drag",), ()]
    assert distinct(sets) == (("tip_drag", "stiction"), (), ("tip_drag",))


def test_the_place_is_that_of_the_first_effect():
    assert places(("tip_drag", "torque_bias")) == "needle"
    assert places(()) == ""
    assert candidate(fit_of(("tip_drag",))).names == ("tip_drag",)
