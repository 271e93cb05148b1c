"""Families of free-form laws: one file per mechanism, found in this folder and those in it."""

import pkgutil
from importlib import import_module

from diagnosis.freeform.family import Family
from diagnosis.freeform.ranges import LogRanges


def files() -> list[str]:
    """Modules that hold families."""
    found = pkgutil.walk_packages(__path__, prefix=f"{__name__}.")
    return sorted(m.name for m in found if not m.ispkg)


def families_of(ranges: LogRanges) -> tuple[Family, ...]:
    """All families that the variables of a log allow."""
    modules = map(import_module, files())
    return tuple(family for module in modules for family in module.families(ranges))
