"""One validation case: a rig, its trials and sensors, and effects of a drawn signature.

The signature of an effect is the root mean square of the change that it causes / sigma, over all samples
and signals of the log. It is drawn for each effect, and the strength that gives it is searched for.
The gap is sqrt(1 + signature^2) of all changes together.

Draws that have a simpler explanation are rejected: an unmodelled effect that a modelled one, or a pair,
would explain; three effects that a pair would explain; stiction that Coulomb friction would explain.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from validation.logs.alternatives import Alternatives, find_alternatives
from validation.logs.comparison import RigComparison
from validation.logs.equivalents import as_effects
from validation.logs.motions import LogPlan, draw_motions, draw_plan
from validation.logs.nearest import NEAREST
from validation.logs.rig_draw import draw_rig
from validation.logs.roughness.recording import ROUGHNESSES
from validation.logs.roughness.roughness import Roughness
from validation.logs.roughness.wrong import FAULTS
from validation.logs.schedule import PLAIN_KINDS
from validation.logs.sensors import LogSensors, draw_sensors, plain
from validation.logs.strengths.families import (
    FAMILIES,
    UNLISTED_FAMILIES,
    WRONG_CONSTANT_FAMILIES,
    without,
)
from validation.logs.strengths.unmodelled import UNMODELLED_FAMILIES
from validation.rig.motion import TrialMotion
from validation.rig.rig import IndependentRig
from validation.rig.unmodelled.effect import IdealSignals

NEEDS_SLIDING = {"speed_dependent_friction", "axial_crosstalk", "axially_relieved_friction"}
NEEDS_LOAD = {"load_dependent_friction"}
NEWER = {*WRONG_CONSTANT_FAMILIES, *UNLISTED_FAMILIES, *UNMODELLED_FAMILIES}
"""Logs of what came later have all effects for alternatives; those of before keep their bytes."""
LEAST_UNMODELLED, MOST_UNMODELLED = 2.0, 8.0
"""The range of signatures of unmodelled effects begins and ends no lower."""
LEAST_RESIDUAL_UNMODELLED, LEAST_RESIDUAL = 0.7, 0.3
"""Rms residual / sigma that the best alternative must leave in a case."""
DRAWS = 100


class ImpossibleDraw(Exception):
    """No draw has given the effects signatures in the required range."""


@dataclass(frozen=True, kw_only=True)
class ValidationCase:
    """The true rig, its trials, and the signatures of its effects in them."""

    rig: IndependentRig
    plan: LogPlan
    motions: list[TrialMotion]
    sensors: LogSensors
    signatures: dict[str, float]
    gap: float
    signals: list[IdealSignals]
    alternatives: Alternatives
    roughness: tuple[Roughness, ...] = ()


def draw_case(
    rng: np.random.Generator,
    kind: str,
    names: Sequence[str],
    *,
    short: bool,
    signature: tuple[float, float],
    alternatives: bool = False,
    roughness: Sequence[str] = (),
) -> ValidationCase:
    """Draw until every effect's signature is in its range.

    Args:
      alternatives: search for all alternatives in explained cases, too (slow).
      roughness: names of the roughnesses of the recording; sensors are plain otherwise.

    Raises:
      ImpossibleDraw: no draw has given these effects such signatures.
    """
    for _ in range(DRAWS):
        case = _attempt(rng, kind, names, short, signature, alternatives, roughness)
        if case is not None:
            return case
    raise ImpossibleDraw(
        f"signature: expected a range that logs of kind {kind} with {', '.join(names)} can reach, "
        f"found {signature}, which none of {DRAWS} draws did; widen it"
    )


def _attempt(
    rng: np.random.Generator,
    kind: str,
    names: Sequence[str],
    short: bool,
    ends: tuple[float, float],
    alternatives: bool,
    rough: Sequence[str],
) -> ValidationCase | None:
    slides, loads = bool(NEEDS_SLIDING & {*names}), bool(NEEDS_LOAD & {*names})
    plan = draw_plan(rng, short=short, slides=slides, loads=loads)
    roughness = tuple((ROUGHNESSES | FAULTS)[name](rng) for name in rough)
    for one in roughness:
        plan = one.plan(plan)
    motions, sensors = draw_motions(rng, plan), draw_sensors(rng)
    sensors = plain(sensors) if kind in PLAIN_KINDS else sensors
    for one in roughness:
        motions = one.motions(rng, motions)
    if kind in ("outside", "wrong_outside"):
        ends = (max(ends[0], LEAST_UNMODELLED), max(ends[1], MOST_UNMODELLED))
    coarse = RigComparison(motions, sensors, coarse=True)
    rig = draw_rig(rng, coarse, kind, names, ends)
    if rig is None:
        return None
    least = min(LEAST_RESIDUAL, ends[0] / 3)
    found = _alternatives(coarse, rig, names, least, alternatives)
    if found is None:
        return None
    comparison = RigComparison(motions, sensors)
    case = ValidationCase(
        rig=rig,
        plan=plan,
        motions=motions,
        sensors=sensors,
        signals=comparison.signals(rig),
        signatures={name: comparison.signature(rig, without(rig, name)) for name in names},
        gap=float(np.hypot(1.0, comparison.signature(rig, replace(rig, effects={}, outside={})))),
        alternatives=found,
        roughness=roughness,
    )
    return case if all(ends[0] <= value <= ends[1] for value in case.signatures.values()) else None


def _alternatives(
    comparison: RigComparison,
    rig: IndependentRig,
    names: Sequence[str],
    least: float,
    all_of_them: bool,
) -> Alternatives | None:
    """The alternatives, as far as they are searched for; None if one explains the case equally well."""
    unexplained = bool(rig.outside) and not as_effects(rig)
    for name in names:
        if name in NEAREST:
            near = find_alternatives(comparison, rig, (name,), NEAREST[name])
            needed = LEAST_RESIDUAL_UNMODELLED if unexplained else least
            if min(near.pair_residual, *near.alone.values()) < needed:
                return None
    no_pair = unexplained or len(names) > 2
    if not names or not (no_pair or all_of_them):
        return Alternatives(alone={})
    among = (*FAMILIES, *WRONG_CONSTANT_FAMILIES) if {*names} & NEWER or len(names) > 2 else ()
    found = find_alternatives(comparison, rig, names, among)
    return None if no_pair and found.pair_residual < LEAST_RESIDUAL_UNMODELLED else found
