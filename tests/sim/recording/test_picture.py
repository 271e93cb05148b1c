"""The picture of a recording."""

import matplotlib.image
import numpy as np
import pytest

from models.errors import OutputExists
from sim.recording import picture
from sim.recording.picture import draw
from sim.recording.recording import Recording


def drawn(recording, path):
    draw(recording, path)
    return matplotlib.image.imread(path)


def test_the_picture_shows_the_run(recording, tmp_path):
    image = drawn(recording, tmp_path / "run.png")
    assert image.shape[:2] == (1080, 1080)  # 9 by 9 inches at 120 dots
    red = (image[:320, :, 0] > 0.8) & (image[:320, :, 1] < 0.3)
    assert red.sum() > 300  # the tip's line in the upper third


def test_a_recording_without_the_shape_of_the_shaft_lacks_only_the_lag_along_it(recording, tmp_path):
    columns = [c for c in recording.table if not c.startswith("shaft_")]
    bare = Recording(table=recording.table[columns], parameters=recording.parameters)
    with_shape, without = (drawn(r, tmp_path / f"{i}.png") for i, r in enumerate((recording, bare)))
    assert len(without) < len(with_shape)
    assert np.ptp(without.mean(axis=2)) > 0  # axes are there


def test_no_legend_lies_over_a_curve(recording, tmp_path, monkeypatch):
    monkeypatch.setattr(picture.plt, "close", lambda figure: None)
    drawn(recording, tmp_path / "run.png")
    figure = picture.plt.gcf()
    for axis in figure.axes:
        if axis.get_legend():
            beside = axis.get_legend().get_window_extent()
            assert not beside.overlaps(axis.get_window_extent())
    monkeypatch.undo()
    picture.plt.close(figure)


def test_a_needle_that_does_not_lag_is_drawn_without_a_warning(recording, tmp_path, recwarn):
    still = recording.table.copy()
    for name in still.columns:
        if name.endswith("_deg"):
            still[name] = 0.0
    drawn(Recording(table=still, parameters=recording.parameters), tmp_path / "still.png")
    assert not recwarn.list


def test_a_picture_is_not_drawn_over_another_file(recording, tmp_path):
    path = tmp_path / "run.png"
    path.write_bytes(b"mine")
    with pytest.raises(OutputExists):
        draw(recording, path)
    assert path.read_bytes() == b"mine"
