"""The limits of conclusions from so few figures, in sentences."""

from studies.published.criteria import RELATIVE_SIGMA
from studies.published.fitting.fit import parameter_penalty
from studies.published.material_study import MaterialStudy, TextComparison
from studies.published.report.values import percent, value_text, with_free_length
from studies.published.selection.assumed_sigma import consistent_sets, sigma_needed
from studies.published.selection.quick_damping import quick_damping
from studies.published.selection.verdict import VerdictKind
from studies.published.study import PublishedStudy


def limitations(study: PublishedStudy) -> list[str]:
    """What the figures of plastisol support and what they do not; one or two sentences per point."""
    found = study.plastisol
    return [
        f"{len(found.figures)} figures of plastisol: four of Table II determine one number, the damping "
        "of a slow turn at rest, and its scatter; four of Tables IV and V remain for everything else.",
        _rejection(found),
        _without_fit(found),
        _best_single(found),
        _penalty(len(found.figures)),
        _passing(found),
        *_equivalent(found),
        *(_text_comparison(comparison, found) for comparison in found.text),
    ]


def _rejection(study: MaterialStudy) -> str:
    needed = [f"{percent(sigma_needed(f))} ({f.hypothesis.free_length})" for f in study.stated]
    return (
        "The stated model is rejected, unless the figures of Tables IV and V have standard deviations "
        f"of {' or '.join(needed)} or more."
    )


def _without_fit(study: MaterialStudy) -> str:
    ratios = [quick_damping(f.hypothesis.base.free_mm) for f in study.stated]
    return (
        "If the base moved in the same way at both depths, Table V alone gives the damping of the quick "
        "turn: "
        + " or ".join(f"{r.ratio:.2f} ± {r.sigma:.2f}" for r in ratios)
        + f" of the stated one ({' or '.join(f.hypothesis.free_length for f in study.stated)})."
    )


def _best_single(study: MaterialStudy) -> str:
    best = min(study.singles(), key=lambda f: f.aicc)
    return (
        f"The best single mechanism is {with_free_length(best)}. It would be consistent if the standard "
        f"deviation of Tables IV and V were {percent(sigma_needed(best), 1)}; {percent(RELATIVE_SIGMA)} "
        "is assumed, which is a choice."
    )


def _penalty(figures: int) -> str:
    penalty = parameter_penalty(figures)
    return (
        f"The AICc penalty with {figures} figures is {penalty[2]:.1f} for two parameters, "
        f"{penalty[3]:.0f} for three, {penalty[4]:.0f} for four. A pair of mechanisms "
        "has three with the damping, which leaves two of the four figures of the quick turn to test it: "
        "more parameters are not supported."
    )


def _passing(study: MaterialStudy) -> str:
    (_, *middle, _) = consistent_sets(study.fits).items()
    counts = [f"{count} if their standard deviation is {percent(sigma)}" for sigma, count in middle]
    return (
        "Sets of mechanisms whose chi-square is consistent with Tables IV and V: at least "
        f"{', '.join(counts)} (the fits are those for {percent(RELATIVE_SIGMA)})."
    )


def _equivalent(study: MaterialStudy) -> list[str]:
    verdict = study.verdict
    if verdict.kind is not VerdictKind.UNDECIDED:
        return []
    return [
        f"{len(verdict.confusable)} explanations are equivalent, counted over both free lengths; the "
        f"odds of the first to the next are {verdict.odds:.1f} to 1."
    ]


def _text_comparison(comparison: TextComparison, study: MaterialStudy) -> str:
    """A figure that the text gives in words, the stated model, and the nearest explanation."""
    fits, figure = study.verdict.leading, comparison.figure
    nearest = min(range(len(fits)), key=lambda i: abs(comparison.predicted[i] - figure.value))
    return (
        f"Not used in any fit: {figure.name} is about {figure.value:g} {figure.unit} in the paper's "
        f"text; the stated model gives {value_text(figure, comparison.stated)}, the nearest "
        f"explanation, {with_free_length(fits[nearest])}, "
        f"{value_text(figure, comparison.predicted[nearest])}."
    )
