"""The picture of a draft."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
from lab_files import LAB, write_csv, write_ros2

from diagnosis.lab_files.guesses.draft import drafted
from diagnosis.lab_files.preview import write_preview
from diagnosis.lab_files.readers.read import read_lab_files
from models.errors import OutputExists


@pytest.mark.parametrize("few", [False, True])
def test_a_picture_is_written_of_any_draft(tmp_path, few):
    path = write_csv(tmp_path, LAB[["t (ms)", "free"]]) if few else write_ros2(tmp_path)
    write_preview(drafted(read_lab_files([path])), tmp_path / "preview.png")
    height, width = plt.imread(tmp_path / "preview.png").shape[:2]
    assert width > 300
    assert height > (100 if few else 400)  # a row for each column
    assert plt.get_fignums() == []


@pytest.mark.parametrize("header", ["", "t_ms motor_deg\n", "t_ms a b\n", "a b c\n"])
def test_what_nobody_recognised_is_drawn_over_its_rows(tmp_path, monkeypatch, header):
    """Without header, without times, without an angle of the base: a picture, and never a blank one."""
    path = tmp_path / "run.txt"
    rows = [f"{(7 * i) % 10} {(i % 4) ** 2}" + " 3" * ("b" in header) for i in range(30)]
    path.write_text(header + "\n".join(rows))
    figures = []
    monkeypatch.setattr(plt, "close", figures.append)
    write_preview(drafted(read_lab_files([path])), tmp_path / "preview.png")
    monkeypatch.undo()
    drawn = {axis.get_title(): axis.lines[0] for axis in figures[0].axes if axis.lines}
    assert list(drawn) == (header.split() or ["column 1", "column 2"])
    for line in drawn.values():
        np.testing.assert_array_equal(line.get_xdata(), np.arange(1, 31))
    second = list(drawn.values())[1]
    np.testing.assert_array_equal(second.get_ydata(), [(i % 4) ** 2 for i in range(30)])
    plt.close(figures[0])


def test_columns_beyond_the_most_that_are_drawn_are_counted(tmp_path, monkeypatch):
    path = tmp_path / "run.txt"
    path.write_text("\n".join(" ".join(str((i * k) % 7) for k in range(1, 51)) for i in range(30)))
    figures = []
    monkeypatch.setattr(plt, "close", figures.append)
    write_preview(drafted(read_lab_files([path])), tmp_path / "preview.png")
    monkeypatch.undo()
    assert "2 more columns" in figures[0].get_supxlabel()
    plt.close(figures[0])


def test_a_picture_that_exists_is_kept(tmp_path):
    (tmp_path / "preview.png").write_text("mine")
    with pytest.raises(OutputExists):
        write_preview(drafted(read_lab_files([write_csv(tmp_path)])), tmp_path / "preview.png")
    assert plt.get_fignums() == []
