"""The documentation as a site: it builds without a warning, and needs nothing from a network."""

import argparse
import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from scripts.arguments import parser

ROOT = Path(__file__).parents[2]


def commands_page(of):
    """The function of docs/commands.py, which is no package."""
    spec = importlib.util.spec_from_file_location("commands", ROOT / "docs" / "commands.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.commands_page(of)


def test_every_option_of_the_parser_is_on_the_page():
    page, todo, options = commands_page(parser()), [parser()], set()
    while todo:
        for action in todo.pop()._actions:
            if isinstance(action, argparse._SubParsersAction):
                todo += action.choices.values()
            options |= {o for o in action.option_strings if o not in ("-h", "--help")}
    assert {"--protocol", "--limit", "--accept-guesses", "--signature"} <= options
    assert [option for option in options if f"`{option}" not in page] == []
    assert "## needle blind score" in page


def test_a_bar_in_a_help_text_ends_no_cell():
    one = argparse.ArgumentParser()
    commands = one.add_subparsers()
    commands.add_parser("try", help="try").add_argument("--x", help="a|b")
    assert "| `--x X` | a\\|b |" in commands_page(one)


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """Built as by `make docs`."""
    pytest.importorskip("furo")
    pytest.importorskip("myst_parser")
    out = tmp_path_factory.mktemp("site")
    strict = ["--fail-on-warning", "--keep-going", "--quiet"]
    command = [sys.executable, "-m", "sphinx", *strict, str(ROOT / "docs"), str(out)]
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return out


@pytest.mark.slow
def test_the_site_has_every_page_and_a_search(site):
    pages = [path.relative_to(ROOT / "docs") for path in (ROOT / "docs").rglob("*.md")]
    assert [page for page in pages if not (site / page.with_suffix(".html")).is_file()] == []
    assert "equations" in (site / "searchindex.js").read_text()
    assert "needle blind score" in (site / "reference" / "commands.html").read_text()
    assert "StoppedEarly" in (site / "reference" / "python-api.html").read_text()


@pytest.mark.slow
def test_no_page_loads_anything_from_elsewhere(site):
    loads = r"<(?:script|img|iframe)[^>]*\ssrc=\"(?:https?:)?//|<link[^>]*\shref=\"(?:https?:)?//"
    for page in site.rglob("*.html"):
        assert not re.search(loads, page.read_text()), page
    for style in site.rglob("*.css"):
        assert not re.search(r"(?:@import|url\()\s*[\"']?(?:https?:)?//", style.read_text()), style
