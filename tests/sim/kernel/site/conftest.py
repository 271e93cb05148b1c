"""A row of the law table, for tests of a contact site."""

import pytest


@pytest.fixture
def row(interpreted):
    """A row of the law table from its fields."""
    places = interpreted.memory_map

    def made(**fields):
        values = [0.0] * places.COLUMNS
        for name, value in (
            {"exponent": 1.0, "plateau": 1e-5, "stribeck": 1.0, "axial": 1.0} | fields
        ).items():
            values[getattr(places, f"L_{name.upper()}")] = value
        return values

    return made
