"""The answer in three parts: what was found, how sure that is and how much it explains, what to do.

They open the page and the summary on the screen.
"""

from collections.abc import Sequence

from diagnosis.criteria.assessment import CERTAIN_PROBABILITY
from diagnosis.effects import LIBRARY
from diagnosis.fitting.held_out.words import ONLY_TRIAL, UNSEEN
from diagnosis.freeform.missing.in_words import what_is_missing
from diagnosis.in_sigma import in_sigma
from diagnosis.report.sensors import told_of_sensors
from diagnosis.report.sentences.names import explanation_name, explanations, same_constants, titles
from diagnosis.report.sentences.verdict import headline
from diagnosis.result import Diagnosis
from diagnosis.selection.verdicts.verdict import VerdictKind


def answer(found: Diagnosis) -> tuple[str, str, str]:
    """What was found; how sure that is and how much it explains; what to do next."""
    return f"{headline(found)}.", f"{_sure(found)}.", f"{_next(found)}."


def _sure(found: Diagnosis) -> str:
    if found.stopped and found.stopped.search:
        best = _share(found, "the best so far")
        return f"Not sure, because what was not tried may explain the log as well; {best}"
    match found.verdict.kind:
        case VerdictKind.NONE:
            return f"{_sure_of_nothing(found)}{_beside(found)}"
        case VerdictKind.EXPLAINED:
            return f"{_probability(found)}; {_share(found, 'it')}{_beside(found)}"
        case VerdictKind.UNDECIDED:
            return f"{_sure_of_one(found)}; {_share(found, 'the first')}"
    return _nearest(found)


def _sure_of_one(found: Diagnosis) -> str:
    """How sure it is that it is one of several sets, and what all of them share."""
    sets = [{*names} for names in found.verdict.confusable]
    shared = {*sets[0]}.intersection(*sets)
    delays = {name for name in LIBRARY if LIBRARY[name].delays_a_sensor}
    if shared and all(names - shared <= delays for names in sets):
        certain = [name for name in found.verdict.confusable[0] if name in shared]
        return (
            f"Sure of {titles(certain)}; open is only whether a sensor is late: a filter in it, or "
            "neither, fits as well"
        )
    first = _probability_of(found, found.verdict.confusable[0])
    return f"Sure that it is one of these, but not which one (probability of the first: {first:.3f})"


def _beside(found: Diagnosis) -> str:
    """What no reading of this log can tell from what is named."""
    others = [titles(names) for names in found.verdict.confusable[1:]]
    others += same_constants(found)
    return f"; no reading of this log distinguishes it from {', or '.join(others)}" if others else ""


def _nearest(found: Diagnosis) -> str:
    near = found.assessment.nearest
    if found.missing is not None:
        gap = found.assessment.gap
        return what_is_missing(found.missing, gap.before, gap.after).removesuffix(".")
    if not near.effects:
        return "Nothing that was tried improves on the nominal model"
    share = _share(found, f"the nearest explanation that was tried ({titles(near.effects)})")
    left = found.assessment.breakdown_after.largest
    return f"{share[0].upper()}{share[1:]}; the remaining residual is {left}"


def _sure_of_nothing(found: Diagnosis) -> str:
    limits = found.assessment.detection_limits
    if not limits:
        return "Detection limits were not computed"
    return (
        f"Sure down to the detection limits: any of {len(limits)} effects that is stronger than "
        "its limit would have been seen in 95 of 100 such logs"
    )


def _probability(found: Diagnosis) -> str:
    """Of what is named, beside the most probable of what else was tried."""
    name = explanation_name(found.verdict.effects)
    own = _probability_of(found, found.verdict.effects)
    others = [one for one in explanations(found) if one[0] != name]
    beside = f" (next: {others[0][0]} with {others[0][1]:.3f})" if others else ""
    told = f"above {CERTAIN_PROBABILITY}" if own > CERTAIN_PROBABILITY else f"{own:.3f}"
    return f"Probability {told} among all explanations that were tried{beside}"


def _probability_of(found: Diagnosis, effects: Sequence[str]) -> float:
    """Probability of a set of effects; 0 where it rounds to nothing."""
    return dict(explanations(found)).get(explanation_name(effects), 0.0)


def _share(found: Diagnosis, which: str) -> str:
    gap, where = found.assessment.gap, UNSEEN if len(found.log.trials) > 1 else ONLY_TRIAL
    return (
        f"{which} explains {found.assessment.nearest.power_explained_percent:.1f} % of the power of the "
        f"residual beyond noise, {where}: {in_sigma(gap.before)} → {in_sigma(gap.after)}"
    )


def _next(found: Diagnosis) -> str:
    advice = found.assessment.next_experiment
    if advice:
        return f"Next: {advice}"
    if found.verdict.kind is VerdictKind.NONE:
        change = (
            "fix the sensors, or allow for what they do; the model need not change"
            if told_of_sensors(found)
            else "nothing has to change"
        )
        return (
            f"Next: {change}; if an effect below its detection limit would matter to "
            "you, record trials in which it acts more strongly"
        )
    return "Next: run the diagnosis to its end; it was stopped before the next step was determined"
