"""What is left of a log, and where."""

import math
import statistics

from diagnosis.criteria.assessment import ALMOST_NOTHING_SIGMA
from diagnosis.criteria.residuals import ONE_TRIAL_GAP, OTHER_TRIALS_GAP, STRETCH_S
from diagnosis.fitting.held_out.words import ONLY_TRIAL, SEEN, UNSEEN
from diagnosis.freeform.missing.in_words import where_seen
from diagnosis.in_sigma import in_sigma
from diagnosis.log.trial import SENSORS
from diagnosis.report.sentences.names import best_in_words, capital
from diagnosis.result import Diagnosis

_NO_SHRINK = 5e-3  # of the gap: as good as nothing


def reduction(found: Diagnosis) -> str:
    """How much of the gap is explained."""
    gap = found.assessment.gap
    seen = f"{capital(_on_which_trials(found))},"
    if abs(gap.shrink) < _NO_SHRINK:
        return f"{seen} the residual is {in_sigma(gap.after)}. 1 σ is the noise floor."
    return (
        f"{seen} the residual falls from {in_sigma(gap.before)} to "
        f"{in_sigma(gap.after)}: by {100 * gap.shrink:.1f} % "
        f"(95 % interval {100 * gap.shrink_low:.1f} to {100 * gap.shrink_high:.1f} %). "
        "1 σ is the noise floor."
    )


def _on_which_trials(found: Diagnosis) -> str:
    if len(found.log.trials) == 1:
        return ONLY_TRIAL
    law = found.missing if found.missing and found.missing.law else None
    return where_seen(law) if law else UNSEEN


def with_one_more(found: Diagnosis) -> str:
    """What adding another effect would change; empty where nothing was tried."""
    first = list(found.assessment.with_one_more.items())[:3]
    if not first:
        return ""
    here = found.assessment.fitted_gap
    named = ", ".join(f"with {name} {in_sigma(gap)}" for name, gap in first)
    little = here - first[0][1] < ALMOST_NOTHING_SIGMA * max(here, 1.0)
    change = "changes almost nothing" if little else "would lower the residual"
    return f"Adding another effect {change}: {SEEN} the residual is {in_sigma(here)}, {named}."


def replay_quality(found: Diagnosis) -> list[str]:
    """Noise and numerical error of each sensor."""
    error = found.assessment.numerical_error
    lines = [
        f"{sensor}: σ = {found.noise[sensor]:.3g}; numerical error: "
        + (f"{in_sigma(error[sensor])}" if sensor in error else "not computed")
        for sensor in found.assessment.breakdown.signal
    ]
    base = found.noise["base_angle_deg"]
    return [*lines, f"base_angle_deg: σ = {base:.3g}, smoothed as far as the motion allows"]


def largest_residual(found: Diagnosis) -> str:
    """Where along time the residual of the nominal model is largest."""
    stretch, value = found.assessment.breakdown.worst
    return (
        f"Largest residual of the nominal model in {STRETCH_S:g} s, all sensors together: "
        f"{in_sigma(value)}, {stretch}"
    )


def largest_parts(found: Diagnosis) -> str:
    """In which signal and phase the residual is largest, before and after the best explanation."""
    before, after = (b.largest for b in (found.assessment.breakdown, found.assessment.breakdown_after))
    nominal = f"Residual of the nominal model: {before}"
    return nominal if after == before else f"{nominal}; of {best_in_words(found)}: {after}"


def in_one_trial(found: Diagnosis) -> str:
    """That all of the gap lies in one of several trials; empty: it does not."""
    each: dict[str, list[float]] = {}
    for name, *_, gap in found.assessment.breakdown.time_s:
        each.setdefault(name, []).append(gap**2)
    gaps = {name: math.sqrt(statistics.fmean(squares)) for name, squares in each.items()}
    off = [name for name, gap in gaps.items() if gap > ONE_TRIAL_GAP]
    if len(gaps) == 1 or len(off) != 1 or any(gaps[n] > OTHER_TRIALS_GAP for n in gaps if n not in off):
        return ""
    return (
        f"All of the gap lies in {off[0]} ({in_sigma(gaps[off[0]])}; others are at the noise). "
        "First check what that trial has of its own: its file, lengths, what was done to the rig"
    )


def leading(found: Diagnosis) -> str:
    """Which signal's residual leads the other's, or why that cannot be said."""
    own = found.assessment.shape.leads
    if own is None:
        return (
            "It is not clear which residual leads: this needs both sensors, for at least eight seconds"
        )
    interval = f"(95 % interval {1000 * own.low_s:.0f} to {1000 * own.high_s:.0f} ms)"
    if own.signal:
        other = next(sensor for sensor in SENSORS if sensor != own.signal)
        return (
            f"The residual of {own.signal} leads that of {other} by {1000 * own.by_s:.0f} ms "
            f"{interval}, correlation {own.correlation:.2f}"
        )
    if abs(own.correlation) <= own.chance_limit:
        return (
            "It is not clear which residual leads: their correlation of "
            f"{own.correlation:.2f} is within chance ({own.chance_limit:.2f})"
        )
    return (
        "It is not clear which residual leads: the 95 % interval of the time between them is "
        f"{1000 * own.low_s:.0f} to {1000 * own.high_s:.0f} ms"
    )
