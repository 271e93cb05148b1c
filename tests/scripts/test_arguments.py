"""Arguments: wrong ones are named, with what was probably meant."""

import re

import pytest

from scripts.arguments import PACKAGES, parsed, parser
from scripts.exit_codes import ExitCode


def refused(arguments, capsys):
    """What is said of wrong arguments."""
    with pytest.raises(SystemExit) as ended:
        parsed(arguments)
    assert ended.value.code == ExitCode.REFUSED
    return " ".join(capsys.readouterr().err.split())


@pytest.mark.parametrize(
    ("arguments", "meant"),
    [
        (["diagnos", "log"], "did you mean 'diagnose'?"),
        (["blind", "mak"], "did you mean 'make'?"),
        (["completion", "bsh"], "did you mean 'bash'?"),
        (["replay", "log", "--forse"], "unknown argument '--forse'; did you mean '--force'?"),
        (["blind", "make", "--effect-s=a"], "unknown argument '--effect-s'; did you mean '--effects'?"),
        (["replay", "log", "another"], "unknown argument 'another'; see needle replay --help"),
    ],
)
def test_a_wrong_argument_is_named_with_what_was_meant(arguments, meant, capsys):
    assert meant in refused(arguments, capsys)


def test_what_resembles_no_command_gets_the_list(capsys):
    said = refused(["xyz"], capsys)
    assert "did you mean" not in said
    assert "diagnose" in said


def test_the_version_names_what_computes(capsys):
    with pytest.raises(SystemExit) as ended:
        parsed(["--version"])
    assert ended.value.code == ExitCode.DONE
    said = " ".join(capsys.readouterr().out.split())
    for package in PACKAGES:
        assert re.search(rf"{package} \d+\.\d+\.\d+", said)


def test_help_says_what_every_exit_code_means():
    text = parser().format_help()
    for code in ExitCode:
        assert f"{code.value:>3}  {code.words}" in text


def test_every_command_that_writes_says_where():
    for command in ("demo", "insert", "validate", "control", "import", "replay", "diagnose"):
        help_text = " ".join(parsed_parser(command).format_help().split())
        assert f"default: out/{command}" in help_text


def parsed_parser(command):
    needed = {"import": ["a.csv"], "replay": ["log"]}.get(command, [])
    return parsed([command, *needed]).parser


def test_a_limit_with_a_unit_is_answered_with_how_to_write_it(capsys):
    with pytest.raises(SystemExit):
        parsed(["diagnose", "log", "--limit", "30s"])
    assert "expected seconds, as 30, found '30s'" in capsys.readouterr().err
