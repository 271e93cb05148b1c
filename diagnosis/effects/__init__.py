"""The library of effects: one small file each, found by looking into this folder.

`LIBRARY` is written for needles like the paper's; `library_of` is the same for a rig of another size.
"""

import pkgutil
from collections.abc import Mapping
from dataclasses import replace
from importlib import import_module

from diagnosis.criteria import INSERTED_AT_LEAST
from diagnosis.effects.effect import Effect, Parameter
from diagnosis.prepare.rig_scale import RigScale

LIBRARY: dict[str, Effect] = {}
for _file in sorted(m.name for m in pkgutil.iter_modules(__path__)):
    if _file != "effect":
        _effect: Effect = import_module(f"{__name__}.{_file}").EFFECT
        LIBRARY[_effect.name] = _effect


def library_of(scale: RigScale) -> Mapping[str, Effect]:
    """The library with the bounds and starts of a rig of this size."""

    def sized(parameter: Parameter) -> Parameter:
        own = parameter.scaled(torque=scale.torque_scale, rate=scale.rate_scale)
        if own.unit == "N mm / mm":
            return own.reaching(scale.dry_n_mm_per_mm)
        deepest = (1 - INSERTED_AT_LEAST) * scale.shallowest_mm
        return own.above(-deepest) if own.unit == "mm" else own

    return {
        name: replace(effect, parameters=tuple(sized(p) for p in effect.parameters))
        for name, effect in LIBRARY.items()
    }
