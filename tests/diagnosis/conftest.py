"""One diagnosed log of a kind, shared by all tests that look at it."""

import contextlib
import io
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from reference_log import make_log
from simulator_spy import SimulatorSpy

from diagnosis.log.rig_log import RigLog, read_rig_log
from diagnosis.pipeline import diagnose
from diagnosis.report.json_report import as_json
from diagnosis.report.write import write_report
from diagnosis.result import Diagnosis
from sim.files import Destination

SHARED = {"dry", "nothing"}


def pytest_collection_modifyitems(items):
    """What waits for a whole diagnosis is slow."""
    for item in items:
        if SHARED & set(getattr(item, "fixturenames", ())):
            item.add_marker(pytest.mark.slow)


@dataclass(frozen=True, kw_only=True)
class Diagnosed:
    """A log of the independent rig, and what was found.

    Attributes:
      report: report.json.
      spy: what was simulated; None: it was not watched.
    """

    folder: Path
    log: RigLog
    found: Diagnosis
    report: dict[str, Any]
    spy: SimulatorSpy | None = None


@pytest.fixture(scope="session")
def dry(tmp_path_factory):
    """A rig with dry friction, diagnosed in this process and watched."""
    folder = make_log(tmp_path_factory.mktemp("dry") / "log", {"coulomb_friction": {"level": 0.0015}})
    log = read_rig_log(folder)
    with SimulatorSpy() as spy:
        found = diagnose(log, workers=1)
    return Diagnosed(folder=folder, log=log, found=found, report=as_json(found), spy=spy)


@pytest.fixture(scope="session")
def written(dry, tmp_path_factory):
    """The report on dry friction, as files."""
    folder = tmp_path_factory.mktemp("report") / "out"
    write_report(dry.found, Destination(folder=folder))
    return folder


@pytest.fixture(scope="session")
def nothing(tmp_path_factory):
    """A rig with nothing unmodelled, diagnosed by the command, over processes."""
    from scripts import diagnose as command
    from scripts.main import main

    folder = make_log(tmp_path_factory.mktemp("none") / "log", {}, seed=3)
    found, printed = [], io.StringIO()

    def kept(*arguments, **options):
        found.append(diagnose(*arguments, **options))
        return found[-1]

    with pytest.MonkeyPatch.context() as patch, contextlib.redirect_stdout(printed):
        patch.setattr(command, "diagnose", kept)
        assert main(["diagnose", str(folder), "--json"]) == 0
    report = json.loads(printed.getvalue(), parse_constant=pytest.fail)
    return Diagnosed(folder=folder, log=read_rig_log(folder), found=found[0], report=report)
