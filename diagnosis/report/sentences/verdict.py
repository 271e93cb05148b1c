"""The verdict in one sentence."""

from collections.abc import Sequence

from diagnosis.effects import IMPERFECTIONS
from diagnosis.fitting.held_out.words import UNSEEN
from diagnosis.in_sigma import in_sigma
from diagnosis.log.trial import SENSORS
from diagnosis.report.sensors import told_of_sensors
from diagnosis.report.sentences.names import capital, same_constants, titles
from diagnosis.result import Diagnosis
from diagnosis.selection.verdicts.verdict import VerdictKind

_NOTHING = "the nominal model as it is"
_FAR_FROM_CLAIMED = 10.0  # times the noise in rig.yaml: what no model explains is likely in it
_TOGETHER = 0.6  # of the residual on unseen trials: what is left of all trials fitted at once
_LEAST_PERCENT = 1.0  # of the power of a residual, which is told as a number
_SETS = 4  # explanations that are told in a sentence


def headline(found: Diagnosis) -> str:
    """The verdict in one sentence, marked where the diagnosis was stopped early."""
    early = found.stopped
    if early is None:
        return _verdict(found)
    told = _best_so_far(found) if early.search else _verdict(found)
    return f"Stopped early ({early.why}, while {early.stage}): best so far: {told}"


def _best_so_far(found: Diagnosis) -> str:
    """What a search that was cut short has come to: never that nothing else is there."""
    verdict, near = found.verdict, found.assessment.nearest
    residual = f"residual {_residual(found)}"
    if verdict.kind is VerdictKind.UNKNOWN:
        none = f"{titles(near.effects) or _NOTHING}, which does not explain the gap: {residual}"
        return f"{none}{_of_all_trials_together(found)}"
    return f"{_each_of(verdict.confusable)}: undecided, because others were not tried: {residual}"


def _verdict(found: Diagnosis) -> str:
    effects, residual = found.verdict.effects, _residual(found)
    match found.verdict.kind:
        case VerdictKind.NONE:
            return _nothing(found)
        case VerdictKind.EXPLAINED:
            verb = "explain" if len(effects) > 1 else "explains"
            return capital(f"{titles(effects)} {verb} the gap: residual {residual}")
        case VerdictKind.UNDECIDED:
            sets = _each_of(found.verdict.confusable)
            return f"Undecided: any of these may explain the gap: {sets}; residual {residual}"
        case _:
            return _unknown(found)


def _residual(found: Diagnosis) -> str:
    gap = found.assessment.gap
    return f"{in_sigma(gap.before)} → {in_sigma(gap.after)} {_what_sigma_is(found)}"


def _nothing(found: Diagnosis) -> str:
    left = f"{in_sigma(found.assessment.gap.after)} {_what_sigma_is(found)}"
    if sensors := told_of_sensors(found):
        return (
            "The model of the needle lacks nothing; all of the gap is in the sensors: "
            f"{sensors}. With that allowed for, the nominal model leaves {left}"
        )
    return f"No gap beyond noise: the nominal model explains the log, residual {left}"


def _unknown(found: Diagnosis) -> str:
    """Why nothing explains the log: what would, but does not count, or what comes nearest."""
    best, near = found.verdict.best, found.assessment.nearest
    before, sigma = in_sigma(found.assessment.gap.before), _what_sigma_is(found)
    left, named = f"{in_sigma(near.gap_after)} {sigma}", titles(near.effects) or _NOTHING
    if found.verdict.other_form and not near.effects:
        return f"Unknown: residual {before}. What fits all trials is none: {found.verdict.other_form}"
    if found.verdict.other_form:
        would = f"{capital(named)} would leave {left}"
        return f"Unknown: residual {before}. {would}, but {found.verdict.other_form}"
    named += _beside_sensors(near.imperfections)
    power, several = f"{_percent(near.power_explained_percent)} of its power", len(near.effects) > 1
    if best.floor.small and best.objection and {*best.named} == {*near.effects}:
        return (
            f"Unknown: residual {before}. {capital(named)} would leave {left} and explain {power}, "
            f"but {'do' if several else 'does'} not count: {best.objections}"
        )
    least = (
        f"at best {left}, with {named}, which {'explain' if several else 'explains'} {power}"
        if near.effects
        else f"which nothing that was tried lowers {UNSEEN} {sigma}"
    )
    nothing = "Unknown: nothing in the library explains the gap, alone or together"
    if near.effects and found.missing is not None and found.missing.closed:  # a law says more than these
        return f"{nothing}: residual {before}, at best {left}"
    return f"{nothing}: residual {before}, {least}{_of_all_trials_together(found)}"


def _percent(share: float) -> str:
    return f"{share:.0f} %" if share >= _LEAST_PERCENT else f"less than {_LEAST_PERCENT:g} %"


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
    fitted = found.assessment.fitted_gap
    if not best.named or fitted > _TOGETHER * near.gap_after:
        return ""
    leaves = "leave" if len(best.named) > 1 else "leaves"
    return (
        f". {capital(titles(best.named))} {leaves} {in_sigma(fitted)} of all trials together, "
        f"but predictions from the other trials {in_sigma(near.gap_after)}: check whether all were "
        "recorded on the same rig, with the same columns"
    )


def alike(found: Diagnosis) -> str:
    """What the accepted effects cannot be told from, in one sentence; else empty."""
    verdict = found.verdict
    if verdict.kind is not VerdictKind.EXPLAINED:
        return ""
    sets = [titles(names) for names in verdict.confusable[1:]]
    others = "; or ".join([*sets, *same_constants(found)])
    if not others:
        return ""
    return (
        f"Cannot be told from: {others}. These change the readings of this log in the same way, or "
        "nearly so; the named cause is the likeliest one, not the only one"
    )
