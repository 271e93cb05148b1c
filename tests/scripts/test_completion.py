"""Completion of arguments in a shell: the scripts run, and know the commands, options and names."""

import shutil
import subprocess

import pytest

from scripts import completion
from scripts.arguments import SHELLS
from scripts.completion import script
from scripts.main import main


@pytest.fixture(scope="module")
def bash():
    return script("bash")


def completed(text, *words):
    """What bash offers for the last of these words."""
    line = " ".join(f"'{word}'" for word in words)
    asked = f"{text}\nCOMP_WORDS=({line}); COMP_CWORD={len(words) - 1}\n_shtab_needle\n"
    told = asked + 'printf "%s\\n" "${COMPREPLY[@]}"'
    run = subprocess.run(["bash", "-c", told], capture_output=True, text=True, check=True)
    return set(run.stdout.split())


@pytest.mark.skipif(not shutil.which("bash"), reason="needs bash")
@pytest.mark.parametrize(
    ("words", "offered"),
    [
        (["needle", "di"], {"diagnose"}),
        (["needle", "control", "--f"], {"--force"}),
        (["needle", "insert", "--protocol", "fig4-1"], {"fig4-10cm"}),
        (["needle", "insert", "--controller", "least"], {"least_time"}),
        (["needle", "blind", "make", "--effects", "coul"], {"coulomb_friction"}),
    ],
)
def test_bash_completes(bash, words, offered):
    assert offered <= completed(bash, *words)


@pytest.mark.parametrize("shell", SHELLS)
@pytest.mark.parametrize("columns", ["60", "200"])
def test_the_command_prints_the_script_and_nothing_else(capfdbinary, monkeypatch, shell, columns):
    monkeypatch.setenv("COLUMNS", columns)
    assert main(["completion", shell]) == 0
    told = capfdbinary.readouterr()
    assert told.out == script(shell).encode()
    assert told.err == b""


def test_tabs_blanks_marks_and_long_lines_stay_as_they_are(capsys, monkeypatch):
    text = "\tif [[ -n $x ]]; then  \n" + "word " * 100 + "[bold]:bomb:\n"
    monkeypatch.setattr(completion, "script", lambda _: text)
    monkeypatch.setenv("COLUMNS", "60")
    assert main(["completion", "bash"]) == 0
    assert capsys.readouterr().out == text


def test_a_script_for_zsh_begins_as_zsh_asks():
    assert script("zsh").startswith("#compdef needle\n")
