"""What comes nearest to an explanation of an unknown log."""

from collections.abc import Sequence

from diagnosis.assessment.uncertainty.values_by_part import ValuesByPart
from diagnosis.in_sigma import in_sigma
from diagnosis.report.sentences.names import by_free_law, titles
from diagnosis.result import Diagnosis
from diagnosis.selection.verdicts.verdict import VerdictKind

NOT_AN_EXPLANATION = (
    "This is not an explanation: something else is at work as well, or instead. The intervals tell how "
    "far parts of the log agree on a value of this model; the value of the rig may be another."
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
        f"{near.power_explained_percent:.0f} % of the power of the residual beyond noise, "
        f"{in_sigma(gap.before)} → {in_sigma(near.gap_after)}. "
        f"No explanation {tried}reaches the noise floor{left}{bound}"
    )


def about_as_near(found: Diagnosis) -> str:
    """Which other sets come about as near to an unknown log, in one sentence; else empty."""
    others = [" + ".join(names) for names in found.verdict.as_near]
    if not others or not found.assessment.nearest.effects:
        return ""
    return (
        "Others come about as near, within a tenth of the residual on the decimated log: "
        f"{'; '.join(others)}. Their order means little, since all of them "
        "lack what is missing"
    )


def differing_trials(found: Diagnosis) -> str:
    """In which parameter of the nearest explanation trials differ most; mostly empty."""
    own = _differing(found, found.assessment.nearest.by_trial)
    if own is None:
        return ""
    values = [_told(value) for value in own.values]
    return (
        f"The trials seem to differ in {_named(own)}. With one value for each "
        f"({_joined(values)}{_unit(own)}), {_leaves(own)}. "
        "Check what was set, zeroed or changed between them"
    )


def differing_motions(found: Diagnosis) -> str:
    """In which parameter of the nearest explanation motions of the base differ most; mostly empty."""
    own = _differing(found, found.assessment.nearest.by_motion)
    if own is None:
        return ""
    each = zip(own.values, own.parts, strict=True)
    values = [f"{_told(value)}{_unit(own)} {part}" for value, part in each if value is not None]
    return (
        f"The motions of the base seem to differ in {_named(own)}. With one value for each "
        f"({_joined(values)}), {_leaves(own)}. "
        "What is missing may depend on the direction, or act at rest"
    )


def _differing(found: Diagnosis, by_part: Sequence[ValuesByPart]) -> ValuesByPart | None:
    """None as well where a free-form law closes the gap: then nothing has to differ."""
    closed = found.missing is not None and found.missing.closed
    return None if closed else next((one for one in by_part if one.differs), None)


def _named(own: ValuesByPart) -> str:
    return f"{own.effect}.{own.parameter}"


def _told(value: float | None) -> str:
    return "not determined" if value is None else f"{value:.3g}"


def _unit(own: ValuesByPart) -> str:
    return "" if own.unit == "-" else f" {own.unit}"


def _joined(each: Sequence[str]) -> str:
    *others, last = each
    return f"{', '.join(others)} and {last}" if others else last


def _leaves(own: ValuesByPart) -> str:
    return (
        f"the residual of all trials together falls from {in_sigma(own.gap_common)} to "
        f"{in_sigma(own.gap_own)} (linear estimate)"
    )
