"""What explanations and predictions are called in sentences."""

from collections.abc import Sequence

from diagnosis.assessment.advice.remedies import constants_that_do_the_same
from diagnosis.criteria.assessment import SHOWN_PROBABILITY
from diagnosis.effects import LIBRARY
from diagnosis.result import Diagnosis
from diagnosis.selection.verdicts.verdict import VerdictKind


def titles(effects: Sequence[str]) -> str:
    """Effects in plain words."""
    *others, last = [LIBRARY[name].title for name in effects] or [""]
    return f"{', '.join(others)} and {last}" if others else last


def same_constants(found: Diagnosis) -> tuple[str, ...]:
    """Constants of the rig that would do exactly what an accepted effect does, were they off."""
    return constants_that_do_the_same(found.verdict.effects, found.assessment.parameters, found.log.rig)


def explanations(found: Diagnosis) -> list[tuple[str, float]]:
    """Explanations with their probabilities, most probable first; a set of effects is one.

    Those whose probability rounds to nothing are left out.
    """
    every = [(explanation_name(names), p) for names, p in found.verdict.ranking]
    return [one for one in every if one[1] >= SHOWN_PROBABILITY]


def explanation_name(effects: Sequence[str]) -> str:
    """The name of a set of effects in a table, whatever their order."""
    return " + ".join(sorted(effects)) or "none"


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


def capital(text: str) -> str:
    """A sentence of a phrase."""
    return text[:1].upper() + text[1:]
