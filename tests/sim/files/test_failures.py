"""What the system says becomes a sentence with the path and what to do."""

import errno
import os

import pytest

from models.errors import UnsafeOutput, UnwritableOutput
from sim.files.failures import failures_of, is_of_the_place


@pytest.mark.parametrize(
    ("number", "advice"),
    [
        (errno.ENOSPC, "No space left on device; free some space there"),
        (errno.EACCES, "Permission denied; give a place that you may write to"),
        (errno.EROFS, "Read-only file system; give a place that you may write to"),
        (errno.EBUSY, "Device or resource busy; give another place"),
    ],
)
def test_an_error_of_the_system_says_what_to_do(tmp_path, number, advice):
    said = rf"^{tmp_path}: nothing was written, .*a\.csv: {advice}"
    with pytest.raises(UnwritableOutput, match=said), failures_of(tmp_path):
        raise OSError(number, os.strerror(number), str(tmp_path / "a.csv"))


def test_an_error_without_path_or_number_is_told_as_it_is(tmp_path):
    with pytest.raises(UnwritableOutput, match="encoder error"), failures_of(tmp_path):
        raise OSError("encoder error")


def test_other_errors_pass():
    with pytest.raises(UnsafeOutput), failures_of("out"):
        raise UnsafeOutput("as it is")


def test_a_font_that_is_missing_is_not_the_fault_of_the_disk():
    assert is_of_the_place(OSError(errno.ENOSPC, "full"))
    assert not is_of_the_place(OSError(errno.ENOENT, "no such font"))
    assert not is_of_the_place(ValueError("mathtext"))
