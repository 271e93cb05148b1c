"""The planar controller over seeds, some of which never come into the plane."""

import numpy as np
import pytest

from studies.control.steering.planar_spread import PlanarSpread
from studies.control.steering.planar_study import PlaneApproach


def test_the_seeds_that_never_stay_are_counted():
    travelled = np.linspace(0, 120, 121)
    good = PlaneApproach(name="x", travelled_mm=travelled, height_mm=np.where(travelled < 50, 2.0, 0.1))
    bad = PlaneApproach(name="x", travelled_mm=travelled, height_mm=np.full(121, 0.7))
    spread = PlanarSpread.of([good, good, bad])
    assert spread.never == 1
    assert spread.converged_mm.median == 50
    assert spread.rms_mm.largest == pytest.approx(0.7)
