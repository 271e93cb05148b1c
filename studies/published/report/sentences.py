"""The findings in words: a sentence, what the figures can bear, what to measure next."""

from typing import Any

from studies.published.experiments.figures import FRACTION, Figure, Measure
from studies.published.experiments.schedules import watched_s
from studies.published.fitting.fit import Fit
from studies.published.selection.scatter import (
    damping_share,
    odds,
    price,
    scatter_needed,
    sets_that_pass,
)
from studies.published.selection.verdict import Outcome
from studies.published.study import Case, InWords, Study


def title(names: tuple[str, ...]) -> str:
    """A set of effects in words."""
    return " and ".join(names) if names else "nothing"


def sentence(case: Case) -> str:
    """The verdict on one material in one sentence."""
    verdict, count = case.verdict, len(case.figures)
    before = " or ".join(
        f"{f.gap:.1f}{f' ({f.hypothesis.reading})' if len(case.stated) > 1 else ''}" for f in case.stated
    )
    gap = f"the stated model misses the {count} figures of {case.material} by {before} spreads"
    best = f"{title(verdict.best.hypothesis.names)} leaves {verdict.best.gap:.1f}"
    match verdict.outcome:
        case Outcome.NONE:
            return f"none: the stated model meets the {count} figures of {case.material}"
        case Outcome.EXPLAINED:
            return f"explained: {gap}, and {best}"
        case Outcome.UNDECIDED:
            sets = "; ".join(map(title, verdict.confusable))
            return f"undecided: {gap}; {len(verdict.confusable)} explanations close it alike: {sets}"
        case _:
            return f"unknown: {gap}, and nothing that was tried closes it; {best}"


def limits(study: Study) -> list[str]:
    """How much the figures support, in sentences."""
    case, verdict = study.plastisol, study.plastisol.verdict
    count, shares = len(case.figures), [damping_share(f.hypothesis.base.free_mm) for f in case.stated]
    needed = [f"{100 * scatter_needed(f):.0f} % ({f.hypothesis.reading})" for f in case.stated]
    alone = min((f for f in case.fits if len(f.hypothesis.names) == 1), key=lambda f: f.aicc)
    prices, passing = price(count), list(sets_that_pass(case.fits).items())[1:3]
    said = [
        f"{count} figures of plastisol: four of Table II fix one number, the damping of a slow turn at "
        "rest, and its scatter; four of Tables IV and V are left for everything else.",
        "The stated model is rejected: Tables IV and V would have to scatter by "
        f"{' or '.join(needed)} for chance to make the difference.",
        "Whatever the base did, if it did the same at both depths, Table V gives the quick turn "
        + " or ".join(f"{s.value:.2f} +- {s.spread:.2f}" for s in shares)
        + f" of the stated damping ({' or '.join(f.hypothesis.reading for f in case.stated)}).",
        f"Best alone is {title(alone.hypothesis.names)} ({alone.hypothesis.reading}): it would do if "
        f"Tables IV and V scattered by {100 * scatter_needed(alone):.1f} %; they are taken to scatter "
        f"by {100 * FRACTION:g} %, which is a choice.",
        f"AICc asks {prices[2]:.1f} for two parameters of {count} figures, {prices[3]:.0f} for three, "
        f"{prices[4]:.0f} for four. A pair of effects has three with the damping, and leaves two of the "
        "four figures of the quick turn to test it: more cannot be supported.",
        "By chi-square alone "
        + ", ".join(
            f"{n} sets of effects pass if Tables IV and V scatter by {100 * x:g} %" for x, n in passing
        )
        + " (at the least: fits are those for the scatter taken).",
    ]
    if verdict.outcome is Outcome.UNDECIDED:
        said.append(
            f"{len(verdict.confusable)} explanations are left, in both readings together; the odds of "
            f"the first to the next are {odds(verdict):.1f} to 1."
        )
    return [*said, *(_said_in_words(w, case) for w in case.in_words)]


def _said_in_words(said: InWords, case: Case) -> str:
    """What becomes of a figure that the text gives in words."""
    fits, figure = case.verdict.accepted or (case.verdict.best,), said.figure
    nearest = min(range(len(fits)), key=lambda i: abs(said.predicted[i] - figure.value))
    hypothesis = fits[nearest].hypothesis
    best = shown(figure, said.predicted[nearest])
    return (
        f"Not fitted: {figure.name} is about {figure.value:g} {figure.unit} in the paper's words; the "
        f"stated model gives {shown(figure, said.stated)}, nearest of the explanations is "
        f"{title(hypothesis.names)} ({hypothesis.reading}) with {best}."
    )


def next_experiment(study: Study) -> str:
    """What to measure next; empty where nothing is left to tell apart."""
    if study.plastisol.verdict.outcome is not Outcome.UNDECIDED:
        return ""
    first = study.prospects[0]
    return (
        "record the base angle of the quick turn, which the paper does not print; then "
        f"{first.figure.measure.value} ({first.figure.experiment.value}, plastisol, "
        f"{first.figure.depth_mm / 10:g} cm) tells {100 * first.apart:.0f} % of the pairs of "
        "explanations apart"
    )


def shown(figure: Figure, value: float) -> str:
    """A predicted figure for people; a turn that does not settle says so."""
    if figure.measure is Measure.SETTLING and value > watched_s(figure.depth_mm):
        return f"> {watched_s(figure.depth_mm):g}"
    return f"{value:.3g}"


def parameters(fit: Fit) -> dict[str, dict[str, dict[str, Any]]]:
    """Fitted values with 95 % intervals, by candidate and parameter."""
    intervals = iter(fit.intervals())
    found: dict[str, dict[str, dict[str, Any]]] = {}
    for candidate in fit.hypothesis.candidates:
        for p in candidate.parameters:
            value, low, high = next(intervals)
            entry = {"value": value, "low": low, "high": high, "unit": p.unit}
            found.setdefault(candidate.name, {})[p.name] = entry
    return found
