"""The planar controller: what torsion costs it, and what compensation gives back."""

import math

import numpy as np
import pytest

from studies.control.steering import planar_study
from studies.control.steering.planar_study import PlaneApproach, approach_plane, imaged_approaches

COMPARED = ("its own simulation", "torsion left out", "torsion compensated")


def travels(found):
    return sorted(math.inf if math.isnan(x) else x for x in (a.converged_mm() for a in found))


def test_with_the_pose_known_torsion_doubles_the_travel_and_compensation_takes_it_back():
    approaches = {p.name: p for p in approach_plane(speed_mm_s=7.5, cases=COMPARED)}
    alone = approaches["its own simulation"].converged_mm()
    assert approaches["torsion left out"].converged_mm() > 1.8 * alone  # "twice as long"
    assert approaches["torsion compensated"].converged_mm() < 1.1 * alone


@pytest.mark.slow
def test_with_images_torsion_at_least_doubles_the_travel_and_compensation_takes_it_back():
    found = imaged_approaches(speed_mm_s=7.5, cases=COMPARED, seeds=(1, 2, 3))
    median = {name: travels(approaches)[1] for name, approaches in found.items()}
    assert median["torsion left out"] > 2 * median["its own simulation"]
    assert median["torsion compensated"] < 1.3 * median["its own simulation"]


def test_a_slow_needle_has_no_need_of_compensation_in_its_first_approach():
    found = imaged_approaches(
        speed_mm_s=2.5,
        travel_mm=100.0,
        cases=("its own simulation", "torsion left out"),
        seeds=(2, 3, 4),
    )
    assert travels(found["torsion left out"])[1] < 1.2 * travels(found["its own simulation"])[1]


def test_a_run_repeats_with_its_seed_and_not_with_another():
    def heights(seed):
        case = ("torsion compensated",)
        return imaged_approaches(travel_mm=10.0, cases=case, seeds=(seed,))[case[0]][0].height_mm

    assert np.array_equal(heights(1), heights(1))
    assert not np.array_equal(heights(1), heights(2))
    assert planar_study.CAMERA.rate_hz == 7.5


@pytest.mark.parametrize(
    ("heights", "travel"), [([3, 1, 0.4, 0.6, 0.1], 4.0), ([0.1, 0.2], 0.0), ([0.1, 0.9], math.nan)]
)
def test_convergence_is_the_travel_after_which_the_tip_stays_near_the_plane(heights, travel):
    travelled = np.arange(len(heights), dtype=float)
    made = PlaneApproach(name="x", travelled_mm=travelled, height_mm=np.array(heights))
    assert made.converged_mm() == pytest.approx(travel, nan_ok=True)


def test_the_rms_is_that_of_the_heights_after_the_travel():
    made = PlaneApproach(
        name="x", travelled_mm=np.arange(4.0), height_mm=np.array([9.0, 9.0, 3.0, -4.0])
    )
    assert made.rms_mm(2.0) == pytest.approx(math.sqrt(12.5))
