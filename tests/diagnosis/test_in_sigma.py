"""How a residual is written."""

import pytest

from diagnosis.in_sigma import in_sigma, over_sigma


@pytest.mark.parametrize(
    ("value", "told"),
    [
        (123.4, "123"),
        (12.34, "12.3"),
        (9.996, "10.0"),
        (1.8062, "1.81"),
        (0.9996, "1.00"),
        (0.9964, "0.996"),
        (0.0146, "0.015"),
        (0.0, "0.000"),
        (2345.6, "2346"),
    ],
)
def test_three_digits_are_told_and_three_decimals_at_most(value, told):
    assert over_sigma(value) == told
    assert in_sigma(value) == f"{told} σ"
