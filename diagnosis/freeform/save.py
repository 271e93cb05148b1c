"""Saves a free-form law that closed a gap, as an effect for later diagnoses."""

from pathlib import Path

from diagnosis.effects import FITTED
from diagnosis.effects.saved.effect_file import SavedEffect, effect_as_text, refuse_no_effect_name
from diagnosis.effects.saved.folder import OWN_FOLDER, effects_folder
from diagnosis.freeform.missing.missing import Missing
from diagnosis.replay.rig_parameters import RigParameters
from models.errors import InvalidValue


def file_of(name: str) -> Path:
    """The path of a saved effect of this name.

    Raises:
      InvalidValue: the name is not allowed, or the user has no folder for effects.
    """
    refuse_no_effect_name("--save-effect", name)
    if name in FITTED:
        raise InvalidValue("--save-effect", name, "a name that no effect has yet", "take another name")
    folder = effects_folder()
    if folder is None:
        raise InvalidValue("--save-effect", name, "a home folder", f"set {OWN_FOLDER} to a folder")
    return folder / f"{name}.yaml"


def can_be_saved(missing: Missing | None) -> bool:
    """Whether a library could have the law.

    Such a law closes the gap, and is not about a single event, a clock, nor about trials of this log
    alone; nor are those beside it.
    """
    if missing is None or missing.law is None or not missing.closed:
        return False
    if any(law.variable == "event" or law.of_a_clock for law in (missing.law, *missing.beside)):
        return False
    free = _fitted(missing).free
    return free is not None and not any(c.trial for c in free.curves)


def as_file(missing: Missing | None, name: str) -> str:
    """The content of the effect's file; empty if there is no law that a library could have."""
    if missing is None or missing.law is None or not can_be_saved(missing):
        return ""
    rig, usual_deg = _fitted(missing), missing.best.fit.parameterization.base.presliding_deg
    elastic = any(law.place == "tissue" for law in (missing.law, *missing.beside))
    return effect_as_text(
        SavedEffect(
            name=name,
            title=", and ".join(family.effect.title for family in missing.best.families),
            place=missing.law.place,
            stiffness_n_mm_per_rad_per_mm=rig.tissue_stiffness_n_mm_per_rad_per_mm if elastic else 0.0,
            time_constant_s=rig.tissue_time_constant_s if elastic else 0.0,
            presliding_deg=rig.presliding_deg if rig.presliding_deg != usual_deg else None,
            law=rig.free,
        )
    )


def _fitted(missing: Missing) -> RigParameters:
    fit = missing.best.fit
    return fit.parameterization.rig(fit.x)
