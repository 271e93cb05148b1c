"""What a diagnosis says in sentences, for the page, the screen and the recording."""

from collections.abc import Sequence

from diagnosis.criteria import ALMOST_NOTHING_SIGMA, SHOWN_PROBABILITY
from diagnosis.effects import IMPERFECTIONS, LIBRARY
from diagnosis.in_sigma import in_sigma
from diagnosis.log.trial import SENSORS
from diagnosis.result import Diagnosis
from diagnosis.selection.verdicts.verdict import VerdictKind

NOT_AN_EXPLANATION = (
    "This is not an explanation: something else is at work as well, or instead. The intervals tell how "
    "far parts of the log agree on a value of this model; the value of the rig may be another."
)
_NOTHING = "the nominal model as it is"
_FAR_FROM_CLAIMED = 10.0  # times the noise in rig.yaml: what no model explains is likely in it
_TOGETHER = 0.6  # of the residual on unseen trials: what is left of all trials fitted at once
_SETS = 4  # explanations that are told in a sentence
_NO_SHRINK = 5e-4  # of the gap: what rounds to 0.0 %


def headline(found: Diagnosis) -> str:
    """The verdict in one sentence, marked where the diagnosis was stopped early."""
    early = found.stopped
    if early is None:
        return _verdict(found)
    told = _best_so_far(found) if early.search else _verdict(found)
    return f"Stopped early ({early.why}, while {early.stage}): best so far: {told}"


def _best_so_far(found: Diagnosis) -> str:
    """What a search that was cut short has come to: never that nothing else is there."""
    verdict, near, gap = found.verdict, found.assessment.nearest, found.assessment.gap
    residual = f"residual {in_sigma(gap.before)} → {in_sigma(gap.after)} {_what_sigma_is(found)}"
    if verdict.kind is VerdictKind.UNKNOWN:
        none = f"{titles(near.effects) or _NOTHING}, which does not explain the gap: {residual}"
        return f"{none}{_of_all_trials_together(found)}"
    return f"{_each_of(verdict.confusable)}: undecided, because others were not tried: {residual}"


def _verdict(found: Diagnosis) -> str:
    gap, effects = found.assessment.gap, found.verdict.effects
    sigma = _what_sigma_is(found)
    before, after = f"{in_sigma(gap.before)}", f"{in_sigma(gap.after)} {sigma}"
    match found.verdict.kind:
        case VerdictKind.NONE:
            return f"No gap beyond noise: the nominal model explains the log, residual {after}"
        case VerdictKind.EXPLAINED:
            verb = "explain" if len(effects) > 1 else "explains"
            return _capital(f"{titles(effects)} {verb} the gap: residual {before} → {after}")
        case VerdictKind.UNDECIDED:
            sets = _each_of(found.verdict.confusable)
            return f"Undecided: these explain the gap equally well: {sets}; residual {before} → {after}"
        case _:
            near = found.assessment.nearest
            if found.verdict.other_form:
                return (
                    f"Unknown: residual {before}. {_capital(titles(near.effects))} would leave "
                    f"{in_sigma(near.gap_after)} {sigma}, but {found.verdict.other_form} "
                    "leaves clearly less"
                )
            best, named = found.verdict.best, titles(near.effects) or _NOTHING
            named += _beside_sensors(near.imperfections)
            power = f"{near.power_explained_percent:.0f} % of its power"
            if best.floor.small and best.objection and {*best.named} == {*near.effects}:
                return (
                    f"Unknown: residual {before}. {_capital(named)} would leave "
                    f"{in_sigma(near.gap_after)} {sigma} and explain {power}, but "
                    f"{'do' if len(near.effects) > 1 else 'does'} not count: {best.objection}"
                )
            least = (
                f"at best {in_sigma(near.gap_after)} {sigma}, with {named}, which "
                f"{'explain' if len(near.effects) > 1 else 'explains'} {power}"
                if near.effects
                else f"which none of them lowers {sigma}"
            )
            return (
                "Unknown: no effect of the library, nor two or three together, explains the gap: "
                f"residual {before}, {least}{_of_all_trials_together(found)}"
            )


def _each_of(sets: Sequence[Sequence[str]]) -> str:
    """Sets of effects, the first of them where they are many."""
    shown = sets if len(sets) <= _SETS + 1 else sets[:_SETS]
    told = "; or ".join(titles(names) or _NOTHING for names in shown)
    more = len(sets) - len(shown)
    return f"{told}; or one of {more} others, which report.json lists" if more else told


def _beside_sensors(imperfections: Sequence[str]) -> str:
    """What the sensors do beside the effects that are named, as the end of a phrase."""
    each = " and ".join(IMPERFECTIONS[name].title for name in imperfections)
    return f", beside {each}" if each else ""


def _what_sigma_is(found: Diagnosis) -> str:
    """In parentheses: the sensors' noise, or what was taken for it where rig.yaml states far less."""
    claims = found.log.rig.sensors.by_column()
    times = max((found.noise[s] / claims[s] for s in SENSORS if claims[s] > 0.0), default=1.0)
    if times < _FAR_FROM_CLAIMED:
        return "(σ = sensor noise)"
    return f"(σ = what the readings scatter by, {times:.0f} times the noise in rig.yaml)"


def _of_all_trials_together(found: Diagnosis) -> str:
    """What fits all trials at once far better than it predicts one from the others; mostly empty."""
    best, near = found.verdict.best, found.assessment.nearest
    if not best.named or best.fit.gap > _TOGETHER * near.gap_after:
        return ""
    leaves = "leave" if len(best.named) > 1 else "leaves"
    return (
        f". {_capital(titles(best.named))} {leaves} {in_sigma(best.fit.gap)} of all trials together, "
        f"but predictions from the other trials {in_sigma(near.gap_after)}: check whether all were "
        "recorded on the same rig, with the same columns"
    )


def nearest(found: Diagnosis) -> str:
    """What comes nearest to an explanation of an unknown log, in one sentence; else empty."""
    near, gap = found.assessment.nearest, found.assessment.gap
    if found.verdict.kind is not VerdictKind.UNKNOWN:
        return ""
    if not near.effects:
        return "Nearest: nothing that was tried improves on the nominal model"
    values = [
        f"{effect} {name} {interval.value:.3g} {interval.unit}".removesuffix(" -")
        for effect, own in near.parameters.items()
        for name, interval in own.items()
    ]
    verb = "explain" if len(near.effects) > 1 else "explains"
    bound = f"; stopped at a bound: {', '.join(near.at_bound)}" if near.at_bound else ""
    tried = "that was tried so far " if found.stopped and found.stopped.search else ""
    left = (
        ""
        if by_free_law(found)
        else f": the remaining residual is {found.assessment.breakdown_after.largest}"
    )
    return (
        f"Nearest: {titles(near.effects)} ({', '.join(values)}) {verb} "
        f"{near.power_explained_percent:.0f} % of the power of the gap, {in_sigma(gap.before)} → "
        f"{in_sigma(near.gap_after)}. No explanation {tried}reaches the noise floor{left}{bound}"
    )


def alike(found: Diagnosis) -> str:
    """What the accepted effects cannot be told from, in one sentence; else empty."""
    verdict = found.verdict
    if verdict.kind is not VerdictKind.EXPLAINED or not verdict.confusable:
        return ""
    others = "; or ".join(titles(names) for names in verdict.confusable[1:])
    return (
        f"Cannot be told from: {others}. These change the readings of this log in the same way, or "
        "nearly so; the named cause is the likeliest one, not the only one"
    )


def titles(effects: Sequence[str]) -> str:
    """Effects in plain words."""
    *others, last = [LIBRARY[name].title for name in effects] or [""]
    return f"{', '.join(others)} and {last}" if others else last


def explanations(found: Diagnosis) -> list[tuple[str, float]]:
    """Explanations with their probabilities, most probable first; a set of effects is one.

    Those whose probability rounds to nothing are left out.
    """
    every = [(explanation_name(names), p) for names, p in found.verdict.ranking]
    return [one for one in every if one[1] >= SHOWN_PROBABILITY]


def explanation_name(effects: Sequence[str]) -> str:
    """The name of a set of effects in a table, whatever their order."""
    return " + ".join(sorted(effects)) or "none"


def reduction(found: Diagnosis) -> str:
    """How much of the gap is explained."""
    gap = found.assessment.gap
    seen = "On held-out trials, which the fit has not seen,"
    if len(found.log.trials) == 1:
        seen = "On the only trial, which is also the one that was fitted,"
    if abs(gap.shrink) < _NO_SHRINK:
        return f"{seen} the residual is {in_sigma(gap.after)}. 1 σ is the noise floor."
    return (
        f"{seen} the residual falls from {in_sigma(gap.before)} to "
        f"{in_sigma(gap.after)}: by {100 * gap.shrink:.1f} % "
        f"(95 % interval {100 * gap.shrink_low:.1f} to {100 * gap.shrink_high:.1f} %). "
        "1 σ is the noise floor."
    )


def with_one_more(found: Diagnosis) -> str:
    """What adding another effect would change; empty where nothing was tried."""
    first = list(found.assessment.with_one_more.items())[:3]
    if not first:
        return ""
    here = found.verdict.best.fit.gap
    named = ", ".join(f"with {name} {in_sigma(gap)}" for name, gap in first)
    little = here - first[0][1] < ALMOST_NOTHING_SIGMA * max(here, 1.0)
    change = "changes almost nothing" if little else "would lower the residual"
    return (
        f"Adding another effect {change}: on the trials of the fit the residual is {in_sigma(here)}, "
        f"{named}."
    )


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
    return f"Largest residual of the nominal model: {in_sigma(value)}, {stretch}"


def largest_parts(found: Diagnosis) -> str:
    """In which signal and phase the residual is largest, before and after the best explanation."""
    before, after = (b.largest for b in (found.assessment.breakdown, found.assessment.breakdown_after))
    nominal = f"Residual of the nominal model: {before}"
    return nominal if after == before else f"{nominal}; of {best_in_words(found)}: {after}"


def label_of(found: Diagnosis, prediction: str) -> str:
    """A prediction in a legend: what comes nearest to an unknown log explains nothing."""
    if found.verdict.kind is not VerdictKind.UNKNOWN or prediction != "explained":
        return prediction
    return "free-form law" if by_free_law(found) else "nearest"


def by_free_law(found: Diagnosis) -> bool:
    """Whether what is called explained in the report is with a free-form law."""
    return found.missing is not None and found.missing.law is not None


def best_in_words(found: Diagnosis) -> str:
    """What the best that was found is: of an unknown log, no explanation."""
    if found.verdict.kind is not VerdictKind.UNKNOWN:
        return "the best explanation"
    return "the free-form law" if by_free_law(found) else "what comes nearest"


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
        f"It is not clear which residual leads: perhaps that of {SENSORS[0]}, by "
        f"{1000 * own.by_s:.0f} ms {interval}, correlation {own.correlation:.2f}"
    )


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]
