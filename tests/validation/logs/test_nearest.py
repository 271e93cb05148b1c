"""What looks alike has names that the rig knows."""

from validation.logs.nearest import NEAREST
from validation.logs.strengths.families import ALL_FAMILIES
from validation.rig.modelled import MODELLED, WRONG_CONSTANTS


def test_modelled_effects_look_like_others():
    assert {*NEAREST} <= {*ALL_FAMILIES}
    for name, alike in NEAREST.items():
        assert {*alike} <= {*MODELLED, *WRONG_CONSTANTS} - {name}
