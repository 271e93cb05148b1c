"""Whoever changes `diagnosis/<room>/<module>.py` finds `tests/diagnosis/<room>/test_<module>.py`."""

import ast
from pathlib import Path

import pytest

TESTS = Path(__file__).parent
CODE = TESTS.parents[1] / "diagnosis"
ELSEWHERE = {"criteria"}  # tests/diagnosis/test_criteria.py, for all of them


def modules():
    """Paths below diagnosis/ of all modules that have a test file of their own."""
    for path in sorted(CODE.rglob("*.py")):
        inside = path.relative_to(CODE)
        in_library = inside.parts[0] == "effects" and inside.stem != "effect"
        if path.stem != "__init__" and inside.parts[0] not in ELSEWHERE and not in_library:
            yield inside


def imported(path):
    """Modules that a file imports from."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom):
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


@pytest.mark.parametrize("module", list(modules()), ids=str)
def test_every_module_is_tested_by_the_file_of_its_name(module):
    path = TESTS / module.parent / f"test_{module.name}"
    assert path.is_file()
    assert ".".join(("diagnosis", *module.with_suffix("").parts)) in set(imported(path))
