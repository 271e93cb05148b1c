"""Every number that decides something is used, and is told where it comes from."""

import ast
from pathlib import Path

import pytest

from diagnosis import criteria

CRITERIA = Path(criteria.__file__).parent
MODULES = sorted(CRITERIA.glob("*.py"))


def assigned(path):
    """Names that a module gives a value."""
    for node in ast.parse(path.read_text()).body:
        if isinstance(node, ast.Assign):
            for target in node.targets:
                parts = target.elts if isinstance(target, ast.Tuple) else [target]
                yield from (part.id for part in parts)


def names():
    """Of all criteria."""
    return [name for path in MODULES for name in assigned(path)]


def used(path):
    """Names that a module reads."""
    nodes = ast.walk(ast.parse(path.read_text()))
    return {n.id for n in nodes if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load)}


@pytest.fixture(scope="module")
def in_use():
    rest = (path for path in CRITERIA.parent.rglob("*.py") if path.parent != CRITERIA)
    return set().union(*(used(path) for path in rest))


@pytest.mark.parametrize("name", names())
def test_every_criterion_decides_something(in_use, name):
    assert name in in_use


def test_every_criterion_has_one_value():
    """A second one of the same name would take the place of the first, wherever that is used."""
    assert len(names()) == len(set(names()))
