"""Median and range over seeds, some of which never come into the plane."""

import math

import numpy as np
import pytest

from studies.control.steering.planar_spread import PlanarSpread, Spread
from studies.control.steering.planar_study import PlaneApproach


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ([3, 1, 2], (2, 1, 3)),
        ([3, 1, math.nan], (3, 1, math.nan)),
        ([math.nan, 1, math.nan], (math.nan, 1, math.nan)),
        ([1, 2, 3, math.nan], (2.5, 1, math.nan)),
    ],
)
def test_never_ranks_after_every_number(values, expected):
    spread = Spread.of(values)
    assert (spread.median, spread.least, spread.largest) == pytest.approx(expected, nan_ok=True)


def test_the_seeds_that_never_stay_are_counted():
    travelled = np.linspace(0, 120, 121)
    good = PlaneApproach(name="x", travelled_mm=travelled, height_mm=np.where(travelled < 50, 2.0, 0.1))
    bad = PlaneApproach(name="x", travelled_mm=travelled, height_mm=np.full(121, 0.7))
    spread = PlanarSpread.of([good, good, bad])
    assert spread.never == 1
    assert spread.converged_mm.median == 50
    assert spread.rms_mm.largest == pytest.approx(0.7)
