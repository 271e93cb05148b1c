"""The engine that a command line asks for."""

import pytest
from rich.console import Console

from diagnosis.engines.engine import Job
from scripts import engine
from scripts.arguments import parser
from scripts.engine import engine_of


def test_without_an_address_it_is_processes_of_this_machine():
    asked = engine_of(1, None, Console())
    assert list(asked(Job(function="builtins.sum"), [range(3)])) == [(range(3), 3)]


def test_with_an_address_it_is_a_cluster(monkeypatch):
    monkeypatch.setattr(engine, "on_cluster", lambda address, tell: (address, tell("lost [it]")))
    shown = Console(record=True)
    assert engine_of(None, "tcp://head:8786", shown)[0] == "tcp://head:8786"
    assert "lost [it]" in shown.export_text()


@pytest.mark.parametrize("command", [("campaign", "FILE"), ("blind", "score", "DIR")])
def test_both_commands_take_either(command):
    assert parser().parse_args([*command, "--scheduler", "tcp://head:1"]).scheduler == "tcp://head:1"
    assert parser().parse_args([*command, "--workers", "3"]).workers == 3
    with pytest.raises(SystemExit):
        parser().parse_args([*command, "--workers", "3", "--scheduler", "tcp://head:1"])
