"""The head of the page."""

from dataclasses import replace
from datetime import date
from importlib.metadata import PackageNotFoundError

from diagnosis.report.answer import answer
from diagnosis.report.sections import front as module
from diagnosis.report.sections.front import front, tool_version


def test_the_head_is_origin_constants_answer_and_warnings(dry):
    found = replace(
        dry.found,
        log=replace(dry.log, name="run 7", warnings=("mind",)),
        diagnosed_on=date(2026, 2, 3),
    )
    origin, constants, what, sure, then, *warned = front(found)
    assert f"log run 7, diagnosed on 2026-02-03, needle-torsion {tool_version()}" in origin
    assert "0.59 mm, shear modulus 27.2 GPa, damping 0.0172 N mm s / rad / mm; 3 trials" in constants
    assert [what, sure, then] == [
        f"<h1>{answer(found)[0]}</h1>",
        *(f'<p class="lead">{sentence}</p>' for sentence in answer(found)[1:]),
    ]
    assert warned == ['<p class="warning">mind</p>']


def test_a_log_without_a_name_and_a_day_has_none(dry):
    bare = replace(dry.found, log=replace(dry.log, name=""), diagnosed_on=None)
    assert front(bare)[0].startswith('<p class="origin">Gap report: log, needle-torsion ')


def test_a_tool_that_is_not_installed_has_no_version(monkeypatch):
    def missing(_):
        raise PackageNotFoundError

    monkeypatch.setattr(module, "version", missing)
    assert tool_version() == "of unknown version"
