"""All effects that the diagnosis does not model, by name, and the wrong constants without one."""

from validation.rig.unmodelled import drive, interface, needle, sensor, tissue
from validation.rig.unmodelled.effect import UnmodelledEffect

EFFECTS: dict[str, UnmodelledEffect] = {
    **interface.EFFECTS,
    **tissue.EFFECTS,
    **drive.EFFECTS,
    **needle.EFFECTS,
    **sensor.EFFECTS,
}
UNMODELLED = tuple(EFFECTS)

UNLISTED_CONSTANTS: dict[str, UnmodelledEffect] = {
    # A free shaft that is shorter than logged is a spring in the drive of negative compliance.
    "free_length_error": UnmodelledEffect(place=("parameters", "drive"), variables=("torque",)),
    "diameter_error": UnmodelledEffect(place=("parameters",), variables=("torque",)),
}
"""What no effect is named after: `offset`, true less logged free length, mm; `share`, by which the
needle is thicker than stated."""
UNLISTED = tuple(UNLISTED_CONSTANTS)
