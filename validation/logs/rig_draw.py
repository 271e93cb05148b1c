"""Draws a rig: the signature of each effect is drawn, and its strength is searched for."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from validation.logs.comparison import RigComparison
from validation.logs.profiles import log_uniform
from validation.logs.schedule import PARAMETER_ERRORS
from validation.logs.strengths.families import ALL_FAMILIES, with_effect
from validation.rig.rig import IndependentRig

OFF_NOMINAL = 0.02
"""Stiffness and damping of `off_nominal` rigs are off by at most this share."""
TRIES, CLOSENESS = 7, 1.25


def draw_rig(
    rng: np.random.Generator,
    comparison: RigComparison,
    kind: str,
    names: Sequence[str],
    ends: tuple[float, float],
) -> IndependentRig | None:
    """A rig whose effects, each alone, have drawn signatures; None if these trials cannot show them.

    Args:
      ends: smallest and largest signature.
    """
    rig = IndependentRig(damping_n_mm_s_per_mm=round(rng.uniform(0.015, 0.025), 6))
    if kind == "off_nominal":
        scales = {
            name: {"scale": 1 + rng.uniform(-OFF_NOMINAL, OFF_NOMINAL)} for name in PARAMETER_ERRORS
        }
        rig = replace(rig, effects=scales)
    drawn = {name: _of_signature(rng, comparison, rig, name, ends) for name in names}
    for name, parameters in drawn.items():
        if parameters is None:
            return None
        rig = with_effect(rig, name, parameters)
    return rig


def _of_signature(
    rng: np.random.Generator,
    comparison: RigComparison,
    rig: IndependentRig,
    name: str,
    ends: tuple[float, float],
) -> dict[str, float] | None:
    """Parameters with which the effect alone has a drawn signature, within a factor `CLOSENESS`."""
    family = ALL_FAMILIES[name]
    by_strength, target = family.draw(rng), log_uniform(rng, *ends)
    strength = log_uniform(rng, family.low, family.high)
    for _ in range(TRIES):
        parameters = _rounded(by_strength(strength))
        reached = comparison.signature(with_effect(rig, name, parameters), rig)
        if target / CLOSENESS < reached < target * CLOSENESS:
            return parameters
        better = strength * min(max(target / max(reached, 1e-9), 0.05), 20.0)
        better = min(max(better, family.low), family.high)
        if better == strength:
            return None
        strength = better
    return None


def _rounded(parameters: dict[str, float]) -> dict[str, float]:
    return {name: float(f"{value:.5g}") for name, value in parameters.items()}
