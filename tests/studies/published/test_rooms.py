"""Rooms of the study import only those before them."""

import ast
from pathlib import Path

import pytest

import studies.published

FOLDER = Path(studies.published.__file__).parent
ROOMS = ("experiments", "fitting", "selection", "report")


@pytest.mark.parametrize("room", ROOMS[:-1])
def test_a_room_imports_no_later_one_and_not_the_study_itself(room):
    allowed = {"criteria", *ROOMS[: ROOMS.index(room) + 1]}
    files = list((FOLDER / room).glob("*.py"))
    assert files
    for path in files:
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("studies.published"):
                inside = node.module.split(".")[2:3] or [alias.name for alias in node.names]
                assert set(inside) <= allowed, path
