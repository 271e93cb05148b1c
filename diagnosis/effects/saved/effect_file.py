"""effect/1: a free-form law as an effect of the library, in a YAML file.

    format: effect/1
    name: sticky_membrane
    title: dry friction along the shaft that changes with depth
    place: interface
    stiffness_n_mm_per_rad_per_mm: 0        # of Kelvin-Voigt tissue, where the law is of that
    time_constant_s: 0
    presliding_deg: null                    # by which dry friction gives, where the law is of that
    law: {curves: [{acts_on: tissue, variable: depth, places: [...], values: [...]}], ...}

The fields of `law` are those of diagnosis.replay.free_law and free_parts. Its one
parameter is its `strength`: 1 is the law as it was saved.
"""

import re
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path
from typing import Any, Literal

import yaml
from pydantic import Field, model_validator
from pydantic_core import to_jsonable_python

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from models.errors import InvalidValue
from models.plain_yaml import read_record, read_yaml
from models.record import Record

_NAME = r"[a-z][a-z0-9_]{2,40}"
_VERDICTS = ("none", "unknown")  # which a ranking has beside effects
_STRENGTH = Parameter(
    name="strength", unit="-", low=0.02, high=20.0, start=(1.0, 0.3, 3.0), logarithmic=True
)


class SavedEffect(Record):
    """The content of the file of a saved effect."""

    format: Literal["effect/1"] = "effect/1"
    name: str
    """Small letters, digits and underscores."""
    title: str
    place: Place
    stiffness_n_mm_per_rad_per_mm: float = Field(default=0.0, ge=0)
    time_constant_s: float = Field(default=0.0, ge=0)
    presliding_deg: float | None = Field(default=None, gt=0)
    law: FreeLaw

    @model_validator(mode="after")
    def _can_be_an_effect(self) -> "SavedEffect":
        refuse_no_effect_name("name", self.name)
        if self.law == FreeLaw():
            raise InvalidValue("law", {}, "a law that changes something")
        return self

    @property
    def effect(self) -> Effect:
        """The saved effect as an effect of the library."""
        return Effect(
            name=self.name,
            title=self.title,
            place=self.place,
            parameters=(_STRENGTH,),
            apply=partial(_apply, self),
            remedy=f"add the saved law {self.name} to the model, {{strength}} times as strong",
            check="repeat the motion in which the law shows most, and nothing else",
        )


def refuse_no_effect_name(field: str, name: str) -> None:
    """Check that an effect may have this name.

    Raises:
      InvalidValue: names the field and what is expected.
    """
    if not re.fullmatch(_NAME, name):
        expected = "3 to 41 small letters, digits and underscores, the first a letter"
        raise InvalidValue(field, name, expected)
    if name in _VERDICTS:
        raise InvalidValue(field, name, "a name that is no verdict", "take another name")


def read_effect(path: Path) -> Effect:
    """Read the effect of a file.

    Raises:
      InvalidValue: names file and field.
    """
    content = read_yaml(path, expected="an effect saved by needle diagnose --save-effect")
    return read_record(path, SavedEffect, content).effect


def effect_as_text(saved: SavedEffect) -> str:
    """The content of its file."""
    plain: dict[str, Any] = to_jsonable_python(dict(saved) | {"law": asdict(saved.law)})
    return yaml.safe_dump(plain, sort_keys=False, allow_unicode=True)


def _apply(saved: SavedEffect, rig: RigParameters, strength: float) -> RigParameters:
    law = saved.law.times(strength)
    changed = replace(rig, free=law if rig.free is None else rig.free.beside(law))
    if saved.presliding_deg is not None:
        changed = replace(changed, presliding_deg=saved.presliding_deg)
    if saved.stiffness_n_mm_per_rad_per_mm == 0.0:
        return changed
    return replace(
        changed,
        tissue_stiffness_n_mm_per_rad_per_mm=saved.stiffness_n_mm_per_rad_per_mm / strength,
        tissue_time_constant_s=saved.time_constant_s,
    )
