"""What the tests of reading share."""

import pytest
from analytic_log import write_log


@pytest.fixture
def log(tmp_path):
    """A good log, for one test to change."""
    return write_log(tmp_path / "log")
