"""Curves over what a contact has been through."""

import numpy as np
import pytest

from models.contact import CONTACT_POINTS, ContactCurve, contact_places
from models.errors import InvalidValue

LEVEL = (1.0,) * CONTACT_POINTS


def test_places_go_from_zero_to_the_last_and_are_even_in_the_logarithm():
    places = contact_places(10.0, 500.0)
    assert (places[0], places[-1]) == pytest.approx((0.0, 500.0))
    np.testing.assert_allclose(np.diff(np.log1p(places / 10.0), 2), 0.0, atol=1e-12)
    curve = ContactCurve(over="slip", factors=LEVEL, scale=10.0, last=500.0)
    np.testing.assert_allclose(curve.places, places)


@pytest.mark.parametrize(
    ("field", "bad"),
    [
        ("factors", (1.0, 2.0)),
        ("factors", (*LEVEL[1:], 0.0)),
        ("scale", 0.0),
        ("last", -1.0),
        ("renewal_deg", 0.0),
        ("over", "temperature"),
    ],
)
def test_an_impossible_curve_is_refused_by_the_name_of_its_field(field, bad):
    with pytest.raises(InvalidValue, match=field):
        ContactCurve(**({"over": "age", "factors": LEVEL, "scale": 0.1, "last": 30.0} | {field: bad}))
