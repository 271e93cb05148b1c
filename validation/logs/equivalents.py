"""Which sets of effects no log can tell from the true ones, and which wrong constants are effects.

Without a known torque at the tip, every law is one of angles and of torques over torques. So

- a torque sensor of gain s reads what a rig reads whose stiffness and damping are both s times as high;
- an encoder of the base that reads s theta has the log of a rig that turns s theta, with a tip sensor of
  gain s and torques of gain 1/s: a tip gain of s times the true one, seen from there 1/s of the nominal.

A free length that is d longer than logged is a spring of stiffness rigidity / d before the needle. A
diameter (1 + e) times as large is a stiffness (1 + e)^4 times as high.
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
SCALE_OF_ANGLES = {"base_angle_scale": {"needle_curvature"}}
"""Effects beside which an encoder's gain shows: their law has an angle of its own."""


def acceptable(effects: Sequence[str], *, loaded: bool) -> list[list[str]]:
    """Other sets of effects that fit the log as well, whatever its noise.

    Args:
      loaded: a known torque acts at the tip in some trial: torques then have a scale.
    """
    if loaded:
        return []
    found = []
    for name in effects:
        others = {*effects} - {name}
        if not others & SCALE_OF_ANGLES.get(name, set()):
            found += [sorted(others | {*instead}) for instead in EQUIVALENTS.get(name, ())]
    return found


def as_effects(rig: IndependentRig) -> Mapping[str, Mapping[str, float]]:
    """The effects that the rig's unlisted wrong constants are; empty if there is none for it."""
    longer_mm = rig.outside.get("free_length_error", {}).get("offset", 0.0)
    if longer_mm > 0:
        return {"base_compliance": {"stiffness": rig.law().rigidity / longer_mm}}
    if "diameter_error" in rig.outside:
        return {"stiffness_error": {"scale": (1 + rig.outside["diameter_error"]["share"]) ** 4}}
    return {}
