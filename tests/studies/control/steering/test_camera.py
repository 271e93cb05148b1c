"""The camera: when it exposes, when its images arrive, and how noisy they are."""

import numpy as np
import pytest

from models.errors import InvalidValue
from studies.control.steering.camera import Camera, CameraModel


def views(camera, *, until_s, step_s=0.01, place=lambda t: np.array([t])):
    times = np.arange(0, until_s, step_s)
    return times, [camera.look(t, place(t)) for t in times]


def test_images_arrive_a_delay_after_exposures_at_the_rate_and_show_the_place_of_the_exposure():
    camera = Camera(CameraModel(rate_hz=10, noise_mm=0, delay_s=0.03), seed=1)
    times, seen = views(camera, until_s=1.0)
    exposed = times[[view.exposes for view in seen]]
    arrived = [
        (t, float(view.position_mm[0]))
        for t, view in zip(times, seen, strict=True)
        if view.position_mm is not None
    ]
    assert exposed == pytest.approx(np.arange(10) / 10, abs=1e-9)
    assert [t for t, _ in arrived] == pytest.approx(exposed + 0.03, abs=0.011)
    assert [place for _, place in arrived] == pytest.approx(exposed)


def test_the_noise_has_the_stated_spread_and_repeats_with_its_seed():
    def noise(seed):
        _, seen = views(
            Camera(CameraModel(rate_hz=50, noise_mm=0.4, delay_s=0.0), seed=seed),
            until_s=20.0,
            place=lambda t: np.zeros(3),
        )
        return np.array([view.position_mm for view in seen if view.position_mm is not None])

    first = noise(3)
    assert np.array_equal(first, noise(3))
    assert not np.array_equal(first, noise(4))
    # 2997 numbers: their deviation is known to 1 / sqrt(2 * 2997), four times that is 5 %.
    assert first.std() == pytest.approx(0.4, rel=0.05)


def test_an_image_that_would_arrive_after_the_next_exposure_is_refused():
    with pytest.raises(InvalidValue, match="delay_s"):
        CameraModel(rate_hz=10, delay_s=0.1)
