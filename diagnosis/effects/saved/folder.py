"""The user's folder of saved effects, which every diagnosis reads.

`$NEEDLE_EFFECTS`, else `needle-torsion/effects` in `$XDG_DATA_HOME` or `~/.local/share`. Without a home
there is none. To forget an effect, delete its file.
"""

import os
from collections.abc import Collection
from pathlib import Path

from diagnosis.effects.effect import Effect
from diagnosis.effects.saved.effect_file import read_effect
from models.errors import InvalidValue
from models.names import is_folder

OWN_FOLDER = "NEEDLE_EFFECTS"
_BELOW = Path("needle-torsion") / "effects"


def effects_folder() -> Path | None:
    """The user's folder of effects, which need not exist; None: the user has no home."""
    if own := os.environ.get(OWN_FOLDER):
        return Path(own)
    if data := os.environ.get("XDG_DATA_HOME"):
        return Path(data) / _BELOW
    try:
        return Path.home() / ".local" / "share" / _BELOW
    except RuntimeError:
        return None


def saved_effects(taken: Collection[str]) -> dict[str, Effect]:
    """Effects of the user's folder by name; empty if there is no such folder.

    Args:
      taken: names of the library, which are not allowed.

    Raises:
      InvalidValue: a file holds no effect, or its name is taken or differs from that of the file.
    """
    folder = effects_folder()
    if folder is None or not is_folder(folder):
        return {}
    return {path.stem: _read(path, taken) for path in sorted(folder.glob("*.yaml"))}


def _read(path: Path, taken: Collection[str]) -> Effect:
    effect = read_effect(path)
    if effect.name in taken or effect.name != path.stem:
        expected = "the name of its file, and none of the library's effects"
        raise InvalidValue(f"{path}: name", effect.name, expected, "rename the effect and its file")
    return effect
