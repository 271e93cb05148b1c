"""Completion of arguments in a shell: the scripts run, and know the commands, options and names."""

import shutil
import subprocess

import pytest

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


def test_the_command_prints_a_script_for_zsh(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "40")  # no line is broken
    assert main(["completion", "zsh"]) == 0
    said = capsys.readouterr().out
    assert said.startswith("#compdef needle")
    assert script("zsh").strip() == said.strip()
