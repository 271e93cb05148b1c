"""The verdict and the next experiment, each in one sentence."""

from studies.published.material_study import MaterialStudy
from studies.published.report.values import names_in_words, percent
from studies.published.selection.verdict import VerdictKind
from studies.published.study import PublishedStudy


def verdict_sentence(study: MaterialStudy) -> str:
    """The verdict on one material in one sentence."""
    verdict, best = study.verdict, names_in_words(study.verdict.best.hypothesis.names)
    figures = f"the {len(study.figures)} figures of {study.material}"
    residual = f"rms residual {_stated_residual(study)} → {verdict.best.rms_residual:.1f} σ"
    match verdict.kind:
        case VerdictKind.NONE:
            return f"None: the stated model is consistent with {figures}."
        case VerdictKind.EXPLAINED:
            return f"Explained: {best} explains {figures}, {residual}."
        case VerdictKind.UNDECIDED:
            sets = "; ".join(map(names_in_words, verdict.confusable))
            count = len(verdict.confusable)
            return f"Undecided: {count} explanations of {figures} are equivalent ({sets}), {residual}."
        case _:
            return f"Unknown: nothing that was fitted explains {figures}; best is {best}, {residual}."


def _stated_residual(study: MaterialStudy) -> str:
    return " or ".join(
        f"{f.rms_residual:.1f} σ" + (f" ({f.hypothesis.free_length})" if len(study.stated) > 1 else "")
        for f in study.stated
    )


def next_experiment(study: PublishedStudy) -> str:
    """What to measure next; empty unless several explanations are left."""
    if study.plastisol.verdict.kind is not VerdictKind.UNDECIDED:
        return ""
    first = study.proposed[0]
    of = first.measurement
    return (
        "Record the base angle of the quick turn, which the paper does not print. Then measure the "
        f"{of.quantity.value} ({of.experiment.value}, plastisol, {of.depth_mm / 10:g} cm): it separates "
        f"{percent(first.separated)} of the pairs of explanations."
    )
