"""A free-form law that closed a gap, as an effect that later diagnoses know."""

from pathlib import Path

from diagnosis.effects import FITTED
from diagnosis.effects.saved.effect_file import SavedEffect, effect_as_text, refuse_no_effect_name
from diagnosis.effects.saved.folder import OWN_FOLDER, effects_folder
from diagnosis.freeform.missing import Missing
from models.errors import InvalidValue


def file_of(name: str) -> Path:
    """Where an effect of this name is saved.

    Raises:
      InvalidValue: it may not have the name, or the user has no folder for it.
    """
    refuse_no_effect_name("--save-effect", name)
    if name in FITTED:
        raise InvalidValue("--save-effect", name, "a name that no effect has yet", "take another name")
    folder = effects_folder()
    if folder is None:
        raise InvalidValue("--save-effect", name, "a home folder", f"set {OWN_FOLDER} to a folder")
    return folder / f"{name}.yaml"


def as_file(missing: Missing | None, name: str) -> str:
    """The content of the effect's file; empty: there is no law that a library could have.

    That is one that closes its gap, of no single event.
    """
    if missing is None or missing.law is None or not missing.closed or missing.law.variable == "event":
        return ""
    fit, law = missing.best.fit, missing.law
    rig = fit.parameterization.rig(fit.x)
    if rig.free is None:
        return ""
    elastic = law.place == "tissue"
    return effect_as_text(
        SavedEffect(
            name=name,
            title=missing.best.family.effect.title,
            place=law.place,
            stiffness_n_mm_per_rad_per_mm=rig.tissue_stiffness_n_mm_per_rad_per_mm if elastic else 0.0,
            time_constant_s=rig.tissue_time_constant_s if elastic else 0.0,
            law=rig.free,
        )
    )
