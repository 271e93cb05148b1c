"""What a diagnosis concludes."""

from diagnosis.selection.verdicts.verdict import distinct


def test_sets_that_cannot_be_told_apart_are_named_once_each():
    sets = [("tip_drag", "stiction"), ("stiction", "tip_drag"), (), ("tip_drag",), ()]
    assert distinct(sets) == (("tip_drag", "stiction"), (), ("tip_drag",))
