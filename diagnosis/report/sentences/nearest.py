"""What comes nearest to an explanation of an unknown log."""

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
        f"{near.power_explained_percent:.0f} % of the power of the gap, {in_sigma(gap.before)} → "
        f"{in_sigma(near.gap_after)}. No explanation {tried}reaches the noise floor{left}{bound}"
    )


def about_as_near(found: Diagnosis) -> str:
    """Which other sets come about as near to an unknown log, in one sentence; else empty."""
    others = [" + ".join(names) for names in found.verdict.as_near]
    if not others:
        return ""
    return (
        "Others come about as near, within a tenth of the residual on the decimated log: "
        f"{'; '.join(others)}. What all of them lack decides which leads"
    )


def differing_trials(found: Diagnosis) -> str:
    """Which parameter of the nearest explanation differs most between trials; mostly empty."""
    own = next((one for one in found.assessment.nearest.by_trial if one.differs), None)
    if own is None:
        return ""
    values = ", ".join("–" if v is None else f"{v:.3g}" for v in own.values)
    told = f"{values} {own.unit}".removesuffix(" -")
    return (
        f"The trials seem to differ: if {own.effect}.{own.parameter} has a value of its own in each "
        f"({told}), the nearest explanation leaves {in_sigma(own.gap_own)} of all trials together "
        f"instead of {in_sigma(own.gap_common)} (linear estimate). Check what was set, zeroed or "
        "changed between them"
    )
