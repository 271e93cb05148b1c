"""Sets of effects that no log can tell from the true ones, and wrong constants that equal effects.

Without a known torque at the tip, all laws contain only angles and ratios of torques. So

- a torque sensor of gain s gives the same log as a rig with s times the stiffness and damping; so any
  two of the three, each off by its own factor, give the same log as any other two of them;
- a base encoder that reads s theta gives the same log as a rig that turns by s theta, with a tip sensor
  of gain 1/s and torques of gain 1/s.

A free length that is d longer than logged equals a spring of stiffness rigidity / d before the needle.
A diameter that is (1 + e) times as large equals a stiffness that is (1 + e)^4 times as high.
"""

from collections.abc import Mapping, Sequence

from validation.rig.rig import IndependentRig

EQUIVALENTS: dict[str, tuple[tuple[str, ...], ...]] = {
    "torque_scale": (("damping_error", "stiffness_error"),),
    "base_angle_scale": (
        ("tip_angle_scale", "torque_scale"),
        ("damping_error", "stiffness_error", "tip_angle_scale"),
    ),
}
"""Sets that may stand for an effect where no known torque acts at the tip."""
SCALES_OF_TORQUE = {"damping_error", "stiffness_error", "torque_scale"}
"""Two of these may stand for any other two."""
SCALE_OF_ANGLES = {"base_angle_scale": {"needle_curvature"}}
"""Effects beside which an encoder's gain shows: their law has an angle of its own."""


def acceptable(effects: Sequence[str], *, loaded: bool) -> list[list[str]]:
    """Other sets of effects that fit the log equally well, whatever its noise.

    Args:
      loaded: a known torque acts at the tip in some trial, which sets the scale of torques.
    """
    if loaded:
        return []
    found = []
    for name in effects:
        others = {*effects} - {name}
        if not others & SCALE_OF_ANGLES.get(name, set()):
            found += [sorted(others | {*instead}) for instead in EQUIVALENTS.get(name, ())]
    return [*found, *(two for two in _other_two_scales({*effects}) if two not in found)]


def _other_two_scales(effects: set[str]) -> list[list[str]]:
    """The set with any other two scales of torques in place of two that it has."""
    others = effects - SCALES_OF_TORQUE
    if len(effects - others) != 2:
        return []
    pairs = ({*SCALES_OF_TORQUE} - {name} for name in sorted(SCALES_OF_TORQUE))
    return [sorted(others | pair) for pair in pairs if others | pair != effects]


def as_effects(rig: IndependentRig) -> Mapping[str, Mapping[str, float]]:
    """The effects that are equal to the rig's unlisted wrong constants; empty if there are none."""
    longer_mm = rig.outside.get("free_length_error", {}).get("offset", 0.0)
    if longer_mm > 0:
        return {"base_compliance": {"stiffness": rig.law().rigidity / longer_mm}}
    if "diameter_error" in rig.outside:
        return {"stiffness_error": {"scale": (1 + rig.outside["diameter_error"]["share"]) ** 4}}
    return {}
