"""The picture of a draft."""

import matplotlib.pyplot as plt
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


def test_a_picture_that_exists_is_kept(tmp_path):
    (tmp_path / "preview.png").write_text("mine")
    with pytest.raises(OutputExists):
        write_preview(drafted(read_lab_files([write_csv(tmp_path)])), tmp_path / "preview.png")
    assert plt.get_fignums() == []
