"""Stages in words, and what they usually take."""

import ast
import importlib
from pathlib import Path

import pytest

import diagnosis
from diagnosis.selection.search import STAGES as SEARCHED
from diagnosis.stages import STAGES, in_words, usual

DIAGNOSIS = Path(diagnosis.__file__).parent


def test_a_stage_that_is_not_known_is_told_as_it_is_and_takes_no_time():
    assert in_words("another stage") == "another stage"
    assert usual("another stage").task_s == 0.0


@pytest.mark.parametrize(
    ("stage", "told"),
    [
        ("screening tissue that goes along", "screening effects with tissue that the shaft drags along"),
        ("screening exchanges in the best", "screening others in place of one of the best"),
    ],
)
def test_what_is_screened_for_is_told_as_its_fits_are(stage, told):
    assert in_words(stage) == told


def named_for_workers():
    """Names of stages in calls that hand tasks to workers, by module, where they are constants."""
    hands = {"each", "each_fit", "fit_all", "fit_screened", "begin_all"}
    for path in sorted(DIAGNOSIS.rglob("*.py")):
        names = [*_first_arguments(ast.parse(path.read_text()), hands)]
        if names:
            dotted = ".".join(path.relative_to(DIAGNOSIS.parent).with_suffix("").parts)
            module = importlib.import_module(dotted)
            yield from ((path.name, getattr(module, name, name)) for name in names)


def _first_arguments(tree, hands):
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and node.args and _name_of(node.func) in hands:
            first = node.args[0]
            if isinstance(first, ast.Constant):
                yield first.value
            elif isinstance(first, ast.Name) and first.id.isupper():
                yield first.id


def _name_of(function):
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")


def test_every_stage_that_workers_get_is_known():
    """A name that is not takes no time in the estimate of what is left, and is told as it is."""
    found = [*named_for_workers()]
    assert len(found) > 25
    assert [one for one in found if one[1] not in STAGES] == []


@pytest.mark.parametrize("name", sorted({stage.__name__.replace("_", " ") for stage in SEARCHED}))
def test_what_a_stop_leaves_out_of_the_search_is_told_in_words(name):
    assert in_words(name) != name


def test_words_are_no_names_and_nothing_takes_less_where_nothing_explains_the_log():
    for name, stage in STAGES.items():
        assert stage.words.split()[0].endswith("ing"), name
        assert 0 <= stage.least <= stage.most, name
