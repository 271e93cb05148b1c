"""One set of short logs, diagnosed once, and the committed scores of the long run."""

from pathlib import Path

import pandas as pd
import pytest

from validation.logs.make import make_logs
from validation.score.run import diagnose_all
from validation.score.scores import read_scores

LOGS = 7
DOCS = Path(__file__).parents[3] / "docs"


def pytest_collection_modifyitems(items):
    """What waits for logs to be diagnosed is slow."""
    for item in items:
        if "folder" in getattr(item, "fixturenames", ()) and "validation/score" in str(item.path):
            item.add_marker(pytest.mark.slow)


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    """Seven short logs of all kinds (one of Coulomb friction) and their reports.

    The seed was chosen by the kinds and effects that it gives, before any log was diagnosed.
    """
    folder = tmp_path_factory.mktemp("blind") / "set"
    make_logs(folder, seed=736, count=LOGS, short=True, signature=(1.5, 20.0))
    diagnose_all(folder / "logs", folder / "reports")
    return folder


@pytest.fixture(scope="session")
def scores(folder):
    """The table of these logs."""
    return read_scores(folder)


@pytest.fixture(scope="session")
def long_run():
    """The table of 210 long logs, as `needle blind score` wrote it for docs/accuracy.md."""
    return pd.read_csv(DOCS / "blind_scores.csv", index_col="case")


@pytest.fixture(scope="session")
def weak_run():
    """The table of 228 short logs of one weak effect."""
    return pd.read_csv(DOCS / "blind_weak.csv", index_col="case")
