"""The picture of a recording."""

import matplotlib.image
import numpy as np
import pytest

from models.errors import OutputExists
from sim.recording.picture import draw
from sim.recording.recording import Recording


def drawn(recording, path):
    draw(recording, path)
    return matplotlib.image.imread(path)


def test_the_picture_shows_the_run(recording, tmp_path):
    picture = drawn(recording, tmp_path / "run.png")
    assert picture.shape[:2] == (960, 1080)  # 9 by 8 inches at 120 dots
    red = (picture[:320, :, 0] > 0.8) & (picture[:320, :, 1] < 0.3)
    assert red.sum() > 300  # the tip's line in the upper third


def test_a_recording_without_the_shape_of_the_shaft_lacks_only_the_lag_along_it(recording, tmp_path):
    columns = [c for c in recording.table if not c.startswith("shaft_")]
    bare = Recording(table=recording.table[columns], parameters=recording.parameters)
    with_shape, without = (drawn(r, tmp_path / f"{i}.png") for i, r in enumerate((recording, bare)))
    below = slice(2 * 960 // 3 + 40, None)
    assert np.ptp(without[below].mean(axis=2)) > 0  # axes are there
    assert (without[below] == 1.0).mean() > (with_shape[below] == 1.0).mean()


def test_a_picture_is_not_drawn_over_another_file(recording, tmp_path):
    path = tmp_path / "run.png"
    path.write_bytes(b"mine")
    with pytest.raises(OutputExists):
        draw(recording, path)
    assert path.read_bytes() == b"mine"
