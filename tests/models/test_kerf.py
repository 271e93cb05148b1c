"""What may be said of a kerf."""

import pytest

from models.errors import InvalidValue
from models.kerf import Kerf


@pytest.mark.parametrize(
    "changes",
    [{"torque_n_mm": 0.0}, {"angle_deg": 0.0}, {"travel_mm": -1.0}, {"backwards": 1.5}],
    ids=lambda changes: next(iter(changes)),
)
def test_what_no_kerf_can_have_is_refused(changes):
    with pytest.raises(InvalidValue, match=next(iter(changes))):
        Kerf(**({"torque_n_mm": 0.1, "travel_mm": 5.0} | changes))


def test_by_default_it_is_a_sine_that_is_cut_anew_either_way():
    kerf = Kerf(torque_n_mm=0.1, travel_mm=5.0)
    assert kerf.angle_deg is None
    assert kerf.backwards == 1.0
