"""What several tests share, and how they are spread over processes."""

import gc
import os
from pathlib import Path

import pytest

os.environ.setdefault("CI", "1")  # rerun collects nothing
os.environ.setdefault("MPLBACKEND", "Agg")
os.environ["NEEDLE_EFFECTS"] = os.devnull  # the library is ours alone, whatever its user has saved
for library in ("OPENBLAS", "OMP", "MKL"):
    os.environ.setdefault(
        f"{library}_NUM_THREADS", "1"
    )  # processes share the cores, threads do not help

gc.set_threshold(100_000)  # objects: the ten thousand tests are no garbage to look for

ROOT = Path(__file__).parent
DIAGNOSED = {"dry", "nothing"}
"""Fixtures that wait for a whole diagnosis: one process makes each once."""
LONGEST = "validation/score"
"""The folder whose tests wait longest for what they share: they run first."""


@pytest.hookimpl(tryfirst=True)  # before groups are read
def pytest_collection_modifyitems(items):
    """Tests of a folder share its fixtures: where there are several processes, they run in one."""
    items.sort(key=lambda item: LONGEST not in item.path.as_posix())
    for item in items:
        folder = item.path.relative_to(ROOT).parent.as_posix()
        group = "diagnosed" if DIAGNOSED & set(getattr(item, "fixturenames", ())) else folder
        item.add_marker(pytest.mark.xdist_group(group))
        if "PYTEST_XDIST_WORKER" in os.environ and hasattr(item, "_id"):
            # xdist 3.8 puts the group where pytest 9.2 no longer looks for the name of a test.
            item._id = type(item._id).parse(f"{item.nodeid}@{group}")
