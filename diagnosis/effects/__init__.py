"""The library of effects: one small file each, found by looking into this folder."""

import pkgutil
from importlib import import_module

from diagnosis.effects.effect import Effect

LIBRARY: dict[str, Effect] = {}
for _file in sorted(m.name for m in pkgutil.iter_modules(__path__)):
    if _file != "effect":
        _effect: Effect = import_module(f"{__name__}.{_file}").EFFECT
        LIBRARY[_effect.name] = _effect
