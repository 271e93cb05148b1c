"""The library of effects: one small file each, found in this folder and in the user's own.

`LIBRARY` is the vocabulary of verdicts, `IMPERFECTIONS` are errors of sensors other than noise; fits may
use both. Their bounds suit needles like the paper's; `library_of` scales them for a rig of another size.
"""

import pkgutil
import sys
from collections import ChainMap
from collections.abc import Mapping
from dataclasses import replace
from importlib import import_module
from types import ModuleType

from diagnosis.criteria.prepare import INSERTED_AT_LEAST
from diagnosis.effects import imperfections
from diagnosis.effects.effect import Effect, Parameter
from diagnosis.effects.saved.folder import saved_effects
from diagnosis.prepare.rig_scale import RigScale


def _found_in(package: ModuleType) -> dict[str, Effect]:
    """Effects of the modules of a folder, by name."""
    files = sorted(m.name for m in pkgutil.iter_modules(package.__path__) if not m.ispkg)
    modules = (import_module(f"{package.__name__}.{file}") for file in files if file != "effect")
    return {module.EFFECT.name: module.EFFECT for module in modules}


IMPERFECTIONS = _found_in(imperfections)
"""What sensors do beside noise: fitted where a log asks, told in the report, never named."""
_OWN = _found_in(sys.modules[__name__])
LIBRARY = _OWN | saved_effects({*_OWN, *IMPERFECTIONS})
"""Effects that a verdict may name: the vocabulary, and what the user saved."""
FITTED: Mapping[str, Effect] = ChainMap(IMPERFECTIONS, LIBRARY)
"""All that a fit may use."""


def library_of(scale: RigScale) -> Mapping[str, Effect]:
    """All effects that a fit may use, with bounds and starts for a rig of this size."""

    def sized(parameter: Parameter) -> Parameter:
        own = parameter.scaled(torque=scale.torque_scale, rate=scale.rate_scale)
        if own.unit == "N mm / mm":
            return own.reaching(scale.dry_n_mm_per_mm)
        deepest = (1 - INSERTED_AT_LEAST) * scale.shallowest_mm
        return own.above(-deepest) if own.unit == "mm" else own

    return {
        name: replace(effect, parameters=tuple(sized(p) for p in effect.parameters))
        for name, effect in FITTED.items()
    }
