"""What the log tells about an effect that the library lacks: its place, its variable and its law."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from diagnosis.criteria.fitting import GAP_LIMIT
from diagnosis.criteria.freeform import CLOSED_GAP, FREE_LAW_GAIN, FREE_LAW_LEAVES
from diagnosis.effects.effect import Place
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.fits.held_out_check import share_determined
from diagnosis.freeform.law_curve import Law, laws_of_fit
from diagnosis.freeform.missing.places import likelier_first, probabilities_of_places


@dataclass(frozen=True, kw_only=True)
class Dependence:
    """A variable, and the gap that its best law leaves.

    Attributes:
      title: the quantity that the law gives.
      place: where it acts.
      decimated: whether the gap is that of the decimated log: its samples are means, whose noise is
        less, so gaps are larger, and compare among themselves alone.
    """

    variable: str
    gap_after: float
    title: str
    place: Place
    decimated: bool = False


@dataclass(frozen=True, kw_only=True, eq=False)
class Missing:
    """What the log tells about an effect that the library lacks.

    Attributes:
      place: probabilities of places.
      depends_on: variables, in the order of the gaps that their laws leave.
      law: the law that leaves the smallest gap; None: none leaves clearly less than the library.
      beside: laws that are fitted together with it, and factors of these and of it.
      best: the fit of that law.
      closed: whether the law leaves little more than noise.
      determined_share: share of the readings for which trials other than their own tell the law.
    """

    place: Mapping[Place, float]
    depends_on: tuple[Dependence, ...]
    law: Law | None
    best: FreeFit
    closed: bool
    determined_share: float = 1.0
    beside: tuple[Law, ...] = ()


def missing_of(fits: Sequence[FreeFit], nearest_gap: float, *, one_trial: bool = False) -> Missing:
    """Summarise free-form fits.

    Args:
      nearest_gap: gap of the library's nearest explanation, on unseen trials.
      one_trial: whether the log has one trial only, so that none is unseen.
    """
    ranked = likelier_first(fits)
    best = ranked[0]
    helps = best.final and _leaves_clearly_less(best.gap_after, nearest_gap)
    laws = laws_of_fit(best) if helps else []
    return Missing(
        place=probabilities_of_places(fits, nearest_gap, 0.5 if one_trial else 1.0),
        depends_on=_dependences(ranked),
        law=laws[0] if laws else None,
        beside=tuple(laws[1:]),
        best=best,
        closed=helps and best.gap_after <= CLOSED_GAP,
        determined_share=share_determined(best),
    )


def _leaves_clearly_less(gap: float, nearest_gap: float) -> bool:
    """Whether a law does, than the library; near the noise that shows in what is left beyond it."""
    beyond, nearest = (max(one**2 - 1.0, 0.0) for one in (gap, nearest_gap))
    near = nearest_gap > GAP_LIMIT and beyond < FREE_LAW_LEAVES * nearest
    return gap < FREE_LAW_GAIN * nearest_gap or near


def _dependences(ranked: Sequence[FreeFit]) -> tuple[Dependence, ...]:
    """The variable of the best fit, then the others in the order of their gaps."""
    found: dict[str, Dependence] = {}
    for one, family in ((fit, own) for fit in ranked for own in fit.curves):
        found.setdefault(
            family.says,
            Dependence(
                variable=family.says,
                gap_after=one.gap_after,
                title=family.title,
                place=family.place,
                decimated=not one.final,
            ),
        )
    first, *others = found.values()
    return (first, *sorted(others, key=lambda one: one.gap_after))
