"""Families of free-form laws: one file per place, found in this folder."""

import pkgutil
from importlib import import_module

from diagnosis.freeform.family import Family
from diagnosis.freeform.ranges import LogRanges


def families_of(ranges: LogRanges) -> tuple[Family, ...]:
    """All families that the variables of a log allow."""
    files = sorted(m.name for m in pkgutil.iter_modules(__path__))
    modules = [import_module(f"{__name__}.{file}") for file in files]
    return tuple(family for module in modules for family in module.families(ranges))
