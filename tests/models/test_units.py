"""Conversions against SI."""

import math

import pytest

from models import units


def test_products_of_units_agree_with_si():
    assert pytest.approx(units.N_MM * units.MM) == units.N_MM2
    assert pytest.approx(1e9) == units.GPA_TO_N_PER_MM2 / units.MM**2  # Pa
    assert pytest.approx(1e-3 / 1e-2**3) == units.G_PER_CM3  # 1 g in 1 cm^3, in kg/m^3
    assert pytest.approx(math.pi) == 180 * units.DEG
