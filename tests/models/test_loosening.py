"""What may be said of a chuck that works loose."""

import pytest

from models.drive import Drive
from models.errors import InvalidValue
from models.loosening import Loosening


@pytest.mark.parametrize("changes", [{"play_deg": 0.0}, {"over_s": 0.0}], ids=["play", "over"])
def test_play_that_is_none_or_opens_at_once_is_refused(changes):
    with pytest.raises(InvalidValue, match=next(iter(changes))):
        Loosening(**({"play_deg": 2.0, "from_s": 1.0} | changes))


def test_a_drive_may_have_it_beside_its_play():
    drive = Drive(backlash_deg=1.0, loosens=Loosening(play_deg=2.0, from_s=3.0))
    assert drive.loosens.play_deg == 2.0
    assert Drive().loosens is None
