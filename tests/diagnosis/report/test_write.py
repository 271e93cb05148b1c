"""A diagnosis as files: all of them, or none."""

import json
import os
import subprocess
import sys
from multiprocessing import active_children

import numpy as np
import pandas as pd
import pytest

from diagnosis.report import html_report, recording
from diagnosis.report.fallible import Page
from diagnosis.report.write import output_paths, write_report
from models.errors import OutputExists
from sim.files import Destination


def dies(_):
    """A section that takes its process with it."""
    os._exit(1)


def test_every_file_is_there_and_nothing_else(written, dry):
    found = {path for path in written.rglob("*") if path.is_file()}
    assert found == set(output_paths(dry.log, written))


def test_the_report_on_disk_is_that_of_the_diagnosis(written, dry):
    text = (written / "report.json").read_text()
    assert json.loads(text, parse_constant=pytest.fail) == dry.report


def test_predictions_are_at_the_samples_of_the_log(written, dry):
    for trial, explained in zip(dry.log.trials, dry.found.assessment.explained, strict=True):
        table = pd.read_csv(written / "predictions" / trial.name)
        names = [
            f"{s}_{p}" for s in ("base_torque_n_mm", "tip_angle_deg") for p in ("nominal", "explained")
        ]
        assert list(table.columns) == ["time_s", *names]
        np.testing.assert_allclose(table["time_s"], trial["time_s"], rtol=1e-5)
        np.testing.assert_allclose(
            table["tip_angle_deg_explained"], explained.tip_angle_deg, rtol=1e-5, atol=1e-9
        )


def test_a_report_that_exists_is_kept(written, dry):
    before = (written / "report.html").read_bytes()
    with pytest.raises(OutputExists):
        write_report(dry.found, Destination(folder=written))
    assert (written / "report.html").read_bytes() == before


def test_an_interrupted_report_leaves_nothing(dry, tmp_path, monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(html_report, "page_begun", lambda *_: lambda: Page(text="a page", lacks=()))
    monkeypatch.setattr(recording, "log_gap", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_report(dry.found, Destination(folder=tmp_path))
    assert list(tmp_path.iterdir()) == []


def test_a_page_and_a_recording_that_fail_leave_the_numbers(dry, tmp_path, monkeypatch):
    def fails(*_):
        raise ValueError("mathtext")

    monkeypatch.setattr(html_report, "page_begun", lambda *_: fails)
    monkeypatch.setattr(recording, "log_gap", fails)
    results = write_report(dry.found, Destination(folder=tmp_path))
    assert sorted(path.name for path in results.left_out) == ["gap.rrd", "report.html"]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["predictions", "report.json"]


def test_without_a_library_for_pictures_the_numbers_are_written(dry, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "diagnosis.report.html_report", None)  # its import fails
    monkeypatch.delattr("diagnosis.report.html_report", raising=False)
    results = write_report(dry.found, Destination(folder=tmp_path), workers=1)
    ((path, reason),) = results.left_out.items()
    assert (path.name, "html_report" in reason) == ("report.html", True)
    assert (tmp_path / "report.json").exists()


def test_the_page_does_not_depend_on_the_number_of_processes(written, dry):
    assert (written / "report.html").read_text() == html_report.page(dry.found, dry.report).text


def test_a_process_that_dies_leaves_out_the_page_alone(dry, tmp_path, monkeypatch):
    monkeypatch.setattr(html_report, "rig_section", dies)
    results = write_report(dry.found, Destination(folder=tmp_path))
    assert [path.name for path in results.left_out] == ["report.html"]
    assert (tmp_path / "gap.rrd").exists()
    assert active_children() == []


@pytest.mark.slow
def test_a_diagnosis_begins_without_what_only_its_report_needs():
    loaded = "import sys, scripts.diagnose; print({'matplotlib', 'rerun'} & set(sys.modules))"
    told = subprocess.run([sys.executable, "-c", loaded], capture_output=True, text=True, check=True)
    assert told.stdout == "set()\n"
