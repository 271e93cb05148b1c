"""The files that the study writes."""

import json

import pytest

from diagnosis.report.fallible import Page
from models.errors import OutputExists
from sim.files import Destination
from studies.published.report import files
from studies.published.report.contents import as_json
from studies.published.report.files import output_paths, write_report


def test_page_and_json_are_written_and_not_overwritten_unless_asked(study, tmp_path, monkeypatch):
    monkeypatch.setattr(files, "page", lambda study: Page(text="<html>σ</html>", lacks=()))
    paths = write_report(study, Destination(folder=tmp_path)).made
    assert [p.name for p in paths] == ["paper.html", "paper.json"]
    assert paths == output_paths(tmp_path)
    assert paths[0].read_text(encoding="utf-8") == "<html>σ</html>"
    assert json.loads(paths[1].read_text(), parse_constant=pytest.fail) == as_json(study)
    with pytest.raises(OutputExists):
        write_report(study, Destination(folder=tmp_path))
    assert write_report(study, Destination(folder=tmp_path, force=True)).made == paths


def test_a_page_that_fails_leaves_the_numbers(study, tmp_path, monkeypatch):
    def fails(_):
        raise ValueError("mathtext")

    monkeypatch.setattr(files, "page", fails)
    results = write_report(study, Destination(folder=tmp_path))
    assert results.left_out == {tmp_path / "paper.html": "ValueError: mathtext"}
    assert [path.name for path in tmp_path.iterdir()] == ["paper.json"]
