"""Errors say what was expected and found, and arrive whole from another process."""

import importlib
import pickle
import pkgutil
from pathlib import Path

import pytest

from models.errors import InvalidValue, NeedleError, UnknownName

PACKAGES = ("models", "sim", "controllers", "studies", "diagnosis", "scripts")


def kinds():
    """Every error class of the repository, found by importing every module."""
    for package in PACKAGES:
        for module in pkgutil.walk_packages(importlib.import_module(package).__path__, f"{package}."):
            importlib.import_module(module.name)
    found = [NeedleError]
    for kind in found:
        ours = (k for k in kind.__subclasses__() if k.__module__.split(".")[0] in PACKAGES)
        found += [k for k in ours if k not in found]
    return found


def an_error_of(kind):
    if issubclass(kind, UnknownName):
        return kind("controller", "magic", ["lqr", "adaptive"])
    if issubclass(kind, InvalidValue):
        return kind("inserted_mm", -1.0, "a length of at least 0 mm", "measure it again")
    return kind("expected this, found that")


def test_every_error_survives_pickling_whole():
    every = kinds()
    assert {"UnknownName", "SimulationFailed", "NotARecording"} <= {kind.__name__ for kind in every}
    for kind in every:
        error = an_error_of(kind)
        copy = pickle.loads(pickle.dumps(error))
        assert type(copy) is kind
        assert str(copy) == str(error)
        assert vars(copy) == vars(error)


def test_without_its_own_reduction_an_invalid_value_could_not_be_copied():
    """Negative control: this is what an exception does by itself."""
    kind, arguments, *_ = Exception.__reduce__(an_error_of(InvalidValue))
    with pytest.raises(TypeError, match="expected"):
        kind(*arguments)


def test_a_message_has_field_expectation_value_and_fix():
    error = an_error_of(InvalidValue)
    assert str(error) == "inserted_mm: expected a length of at least 0 mm, found -1.0; measure it again"
    assert (error.field, error.found, error.fix) == ("inserted_mm", -1.0, "measure it again")


def test_a_path_is_shown_as_plain_text():
    error = InvalidValue("out", Path("some/folder"), "a folder that does not exist yet")
    assert str(error) == "out: expected a folder that does not exist yet, found some/folder"


def test_an_unknown_name_lists_the_known_ones_in_order():
    assert str(an_error_of(UnknownName)) == "controller: expected one of adaptive, lqr, found 'magic'"
