"""docs/physics.md: every equation of the paper, and names that exist."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "physics.md").read_text()
LAST = 32
"""Number of the paper's last equation."""
NAMED = sorted(set(re.findall(r"`([\w/]+\.py)(?:::([\w.]+))?`", PAGE)))


def defined(path, name):
    """Whether a file defines a function or class, or a class of it a member."""
    body = ast.parse((ROOT / path).read_text()).body
    for part in name.split("."):
        found = next((node for node in body if getattr(node, "name", None) == part), None)
        if found is None:
            return False
        body = found.body
    return True


@pytest.mark.parametrize(("path", "name"), NAMED)
def test_what_implements_an_equation_exists(path, name):
    assert (ROOT / path).is_file()
    assert not name or defined(path, name)


def test_a_name_that_does_not_exist_is_found():
    assert not defined("models/lag.py", "no_such_function")
    assert not defined("models/modes.py", "InsertedNeedle.no_such_member")


def test_every_equation_has_a_row():
    first = [line.split("|")[1] for line in PAGE.splitlines() if line.startswith("| (")]
    told = set()
    for cell in first:
        numbers = [int(n) for n in re.findall(r"\d+", cell)]
        told |= set(range(numbers[0], numbers[1] + 1)) if "–" in cell else set(numbers)
    assert told == set(range(1, LAST + 1))
