"""Standard output may be full, closed or plain ASCII: one line says so, and no traceback does."""

import io
import os
import sys

import pytest
from rich.console import Console

from scripts import streams
from scripts.main import main
from scripts.progress_line import stage_line
from scripts.terminal import terminal


@pytest.fixture
def output(monkeypatch):
    """Puts a file in the place of standard output."""

    def put(file):
        monkeypatch.setattr(sys, "stdout", file)
        return file

    return put


def closed_pipe():
    reader, writer = os.pipe()
    os.close(reader)
    return os.fdopen(writer, "w")


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="this system has no /dev/full")
def test_a_full_output_is_one_line_and_exit_2(output, capsys):
    with output(open("/dev/full", "w")):
        assert main(["protocols"]) == 2
    said = " ".join(capsys.readouterr().err.split())
    assert said.startswith("needle protocols: standard output")
    assert "No space left on device" in said


def test_a_pipe_that_was_closed_is_one_line_and_exit_2(output, capsys):
    with output(closed_pipe()):
        assert main(["protocols"]) == 2
    assert "Broken pipe" in capsys.readouterr().err


def test_an_output_that_is_not_there_is_no_error(output):
    output(None)
    assert main(["protocols"]) == 0


def test_what_ascii_cannot_show_is_a_question_mark(output):
    shown = io.BytesIO()
    text = output(io.TextIOWrapper(shown, encoding="ascii"))
    streams.show_what_can_be_shown()
    text.write("5 \u03c3")
    text.flush()
    assert shown.getvalue() == b"5 ?"


def test_a_complaint_that_nobody_hears_is_no_error(monkeypatch):
    nobody = closed_pipe()
    monkeypatch.setattr(sys, "stderr", nobody)
    streams.complain("too late")
    os.dup2(os.open(os.devnull, os.O_WRONLY), nobody.fileno())  # what is kept can be let go
    nobody.close()


def test_other_consoles_end_the_process_where_this_one_raises():
    with pytest.raises(BrokenPipeError):
        terminal().on_broken_pipe()
    assert "on_broken_pipe" in vars(Console)  # what is overridden is still asked


def test_progress_goes_to_standard_error_and_loses_no_result(output, monkeypatch, capsys):
    with closed_pipe() as nobody:
        output(nobody)
        with stage_line() as stage:
            stage("simulating", 0.0)
    assert capsys.readouterr().err == "    0 s  simulating\n"
    nobody = closed_pipe()
    monkeypatch.setattr(sys, "stderr", nobody)
    with stage_line() as stage:
        stage("simulating", 0.0)
    os.dup2(os.open(os.devnull, os.O_WRONLY), nobody.fileno())
    nobody.close()
