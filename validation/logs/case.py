"""One case: a rig, its trials and sensors, and effects just as strong as they should be.

The signature of an effect is the root mean square, over all samples and the signals that the log has,
of what the effect changes over the noise. For each effect one is drawn, and the strength that
gives it is sought. The gap is sqrt(1 + the same of everything that is not nominal, squared).

What an effect of the vocabulary, or a pair, would explain as well is no case of "unknown", and stiction
that Coulomb friction would explain is none of stiction: such draws are thrown away.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from validation.logs.comparison import Bench
from validation.logs.motions import Plan, draw_motions, draw_plan
from validation.rig.unmodelled import Trace
from validation.logs.profiles import log_uniform
from validation.rig.rig import Motion, Rig
from validation.logs.alternatives import Rivals, find_rivals
from validation.logs.schedule import PARAMETER_ERRORS
from validation.logs.sensors import Sensors, draw_sensors
from validation.logs.strengths import FAMILIES, OUTSIDE_FAMILIES, with_effect, without

NEEDS_SLIDING = {"speed_dependent_friction", "axial_crosstalk"}
NEEDS_LOAD = {"load_dependent_friction"}
NEAREST = {
    "tip_sensor_lag": ("tip_sensor_delay",),
    "damping_gradient": ("layered_tissue", "base_compliance"),
    "friction_ageing": ("stiction", "coulomb_friction"),
    "one_way_friction": ("stiction", "coulomb_friction"),
    "stiction": ("coulomb_friction",),
}
"""Effects of the vocabulary that may pass for these."""
LEAST_OUTSIDE, MOST_OUTSIDE = 2.0, 8.0
"""Bounds of the signature's range for what is outside."""
LEAST_LEFT_OUTSIDE, LEAST_LEFT = 0.7, 0.3
"""Residual of the best rival, over the noise, that a case must leave."""
OFF_NOMINAL = 0.02
DRAWS, TRIES, CLOSENESS = 100, 7, 1.25


@dataclass(frozen=True, kw_only=True)
class Case:
    """A rig that is true, its trials, and the signatures that they give its effects."""

    rig: Rig
    plan: Plan
    motions: list[Motion]
    sensors: Sensors
    signatures: dict[str, float]
    gap: float
    traces: list[Trace]
    rivals: Rivals


def draw_case(
    rng: np.random.Generator,
    kind: str,
    names: Sequence[str],
    *,
    short: bool,
    signature: tuple[float, float],
    rivals: bool = False,
) -> Case:
    """Draw until every effect's signature is in its range.

    Args:
      rivals: look for all rivals of explained cases, too (slow).

    Raises:
      RuntimeError: no draw has given these effects such signatures.
    """
    for _ in range(DRAWS):
        case = _attempt(rng, kind, names, short, signature, rivals)
        if case is not None:
            return case
    raise RuntimeError(f"signature: no log of {kind} {names} within {signature} after {DRAWS} draws")


def _attempt(
    rng: np.random.Generator,
    kind: str,
    names: Sequence[str],
    short: bool,
    ends: tuple[float, float],
    rivals: bool,
) -> Case | None:
    slides, loads = bool(NEEDS_SLIDING & {*names}), bool(NEEDS_LOAD & {*names})
    plan = draw_plan(rng, short=short, slides=slides, loads=loads)
    motions, sensors = draw_motions(rng, plan), draw_sensors(rng)
    if kind == "outside":
        ends = (max(ends[0], LEAST_OUTSIDE), max(ends[1], MOST_OUTSIDE))
    coarse = Bench(motions, sensors, coarse=True)
    rig = draw_rig(rng, coarse, kind, names, ends)
    found = _distinct(coarse, rig, kind, names, min(LEAST_LEFT, ends[0] / 3), rivals) if rig else None
    if rig is None or found is None:
        return None
    bench = Bench(motions, sensors)
    case = Case(
        rig=rig,
        plan=plan,
        motions=motions,
        sensors=sensors,
        traces=bench.show(rig),
        signatures={name: bench.signature(rig, without(rig, name)) for name in names},
        gap=float(np.hypot(1.0, bench.signature(rig, replace(rig, effects={}, outside={})))),
        rivals=found,
    )
    return case if all(ends[0] <= value <= ends[1] for value in case.signatures.values()) else None


def _distinct(
    bench: Bench, rig: Rig, kind: str, names: Sequence[str], least: float, rivals: bool
) -> Rivals | None:
    """The rivals, as far as they were looked for; none if one of them does as well."""
    for name in names:
        if name in NEAREST:
            near = find_rivals(bench, rig, (name,), NEAREST[name])
            wanted = LEAST_LEFT_OUTSIDE if kind == "outside" else least
            if min(near.pair_residual, *near.alone.values()) < wanted:
                return None
    if not names or (kind != "outside" and not rivals):
        return Rivals(alone={})
    found = find_rivals(bench, rig, names)
    return None if kind == "outside" and found.pair_residual < LEAST_LEFT_OUTSIDE else found


def draw_rig(
    rng: np.random.Generator, bench: Bench, kind: str, names: Sequence[str], ends: tuple[float, float]
) -> Rig | None:
    """A rig whose effects, each for itself, have drawn signatures; None if these trials forbid it."""
    rig = Rig(damping_n_mm_s_per_mm=round(rng.uniform(0.015, 0.025), 6))
    if kind == "off_nominal":
        scales = {
            name: {"scale": 1 + rng.uniform(-OFF_NOMINAL, OFF_NOMINAL)} for name in PARAMETER_ERRORS
        }
        rig = replace(rig, effects=scales)
    found = {name: _strengthened(rng, bench, rig, name, ends) for name in names}
    for name, parameters in found.items():
        if parameters is None:
            return None
        rig = with_effect(rig, name, parameters)
    return rig


def _strengthened(
    rng: np.random.Generator, bench: Bench, rig: Rig, name: str, ends: tuple[float, float]
) -> dict[str, float] | None:
    """Parameters that give the effect alone a drawn signature, near enough."""
    family = (FAMILIES | OUTSIDE_FAMILIES)[name]
    by, wanted = family.draw(rng), log_uniform(rng, *ends)
    strength = log_uniform(rng, family.low, family.high)
    for _ in range(TRIES):
        parameters = _rounded(by(strength))
        got = bench.signature(with_effect(rig, name, parameters), rig)
        if wanted / CLOSENESS < got < wanted * CLOSENESS:
            return parameters
        better = strength * min(max(wanted / max(got, 1e-9), 0.05), 20.0)
        better = min(max(better, family.low), family.high)
        if better == strength:
            return None
        strength = better
    return None


def _rounded(parameters: dict[str, float]) -> dict[str, float]:
    return {name: float(f"{value:.5g}") for name, value in parameters.items()}
