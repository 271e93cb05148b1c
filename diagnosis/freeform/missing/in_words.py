"""What the library lacks, in plain words."""

from collections.abc import Sequence

from diagnosis.criteria.freeform import FAR_GAP
from diagnosis.effects import FITTED
from diagnosis.effects.effect import Place
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.held_out.words import SEEN, unseen
from diagnosis.freeform.family import Family
from diagnosis.freeform.law_curve import Law
from diagnosis.freeform.likeness.likeness import likeness_of
from diagnosis.freeform.likeness.shapes import LEVEL
from diagnosis.freeform.missing.course import course_of
from diagnosis.freeform.missing.missing import Missing
from diagnosis.freeform.missing.words import PLACES, VARIABLES, check_of
from diagnosis.freeform.save import can_be_saved
from diagnosis.in_sigma import in_sigma, over_sigma
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from models.tissue import Interface

DOUBT = (
    "First check what all of these laws assume: lengths, diameter and clocks of the rig, the same zero "
    "in all trials, and that only one thing is missing"
)
_HINT = "still far above the noise: take the curve as a hint only"
_OTHERS = 3
_LOOSE = 1.05  # times the residual in units of noise and the curve's band, from which that is told too
_NEARLY = 0.25  # probability from which another place is told
_TURN_DEG = 360.0
_SEEN_AGAIN = 0.9  # of a period, over which a law is known where it is said to repeat


def what_is_missing(missing: Missing, gap_before: float, gap_after: float | None = None) -> str:
    """One or two sentences: where the effect acts, what it depends on, how much its law explains.

    Args:
      gap_before: gap of the nominal rig, in sigma.
      gap_after: gap with the law, in sigma; None: that in units of noise and the band of its curve.
    """
    if missing.law is None:
        return f"No free-form law that was tried does better than the library. {DOUBT}."
    law, first = missing.law, missing.depends_on[0]
    beside = f", beside {' and '.join(FITTED[n].title for n in law.beside)}," if law.beside else ""
    where = where_seen(missing)
    first_course, *more = (f"{course_of(own)}{repeating(p)}" for own, p in laws_of(missing))
    depends = (
        f"What is missing acts {_where(missing, law.place, first.gap_after)} and depends on "
        f"{VARIABLES[law.variable]}: {first_course}."
    )
    left = first.gap_after if gap_after is None else gap_after
    loose = left > _LOOSE * first.gap_after
    allowing = (
        f", {over_sigma(first.gap_after)} times what noise and the band account for" if loose else ""
    )
    falls = f"the residual from {in_sigma(gap_before)} to {in_sigma(left)} {where}{allowing}"
    if first.gap_after > FAR_GAP:
        return f"{depends} {_with_so_many_more(missing.beside, beside)} {falls}; {_HINT}."
    each = zip(missing.beside, more, strict=True)
    others = "".join(f" {_more_of(law, course, i)}" for i, (law, course) in enumerate(each))
    reduces = "Together they reduce" if others else f"A free-form law of this kind{beside} reduces"
    like = _likeness(law, alone=not missing.beside)
    return f"{depends}{others} {reduces} {falls}{_beside(missing)}.{like}"


def where_seen(missing: Missing) -> str:
    """On which trials the gap of the law is."""
    # Of a trial that no other tells of:
    alone = any(f.of_each_trial or f.effect.trial for f in missing.best.families)
    return unseen(missing.determined_share) if missing.best.held_out and not alone else SEEN


def _with_so_many_more(more: Sequence[Law], beside: str) -> str:
    """That a law, with more laws beside it, reduces a residual that stays far above the noise."""
    if not more:
        return f"A free-form law of this kind{beside} reduces"
    each = (
        f"{'a factor' if law.multiplies else f'one {PLACES[law.place]}'} that depends on "
        f"{VARIABLES[law.variable]}"
        for law in more
    )
    return f"This law{beside.removesuffix(',')}, with {' and '.join(each)}, reduces"


def _where(missing: Missing, place: Place, gap_after: float) -> str:
    """The place of the leading law, and others that are nearly as likely or more so.

    Far above the noise their probabilities are of no law that is right, and are not told.
    """
    others = {p: own for p, own in missing.place.items() if p is not place and own >= _NEARLY}
    own = missing.place[place]
    likelier = max(others, key=others.__getitem__, default=place)
    if gap_after > FAR_GAP:
        return f"most likely {' or '.join(PLACES[p] for p in (place, *others))}"
    if others and others[likelier] > own:
        return (
            f"{PLACES[likelier]} (probability {others[likelier]:.2f}) or {PLACES[place]} ({own:.2f}), "
            "whose law leaves least,"
        )
    more = "".join(f"; {PLACES[p]}: {one:.2f}" for p, one in others.items())
    return f"{PLACES[place]} (probability {own:.2f}{more})"


def laws_of(missing: Missing) -> list[tuple[Law, float]]:
    """The laws that are fitted, the leading one first, and the angle after which each repeats, deg.

    It is 0 for a law that does not.
    """
    laws = (missing.law, *missing.beside) if missing.law else ()
    each = zip(laws, missing.best.curves[: len(laws)], strict=True)
    return [(law, 0.0 if law.multiplies else _seen_period_deg(law, missing, f)) for law, f in each]


def _seen_period_deg(law: Law, missing: Missing, family: Family) -> float:
    """The angle after which a law repeats, deg; 0: it does not, or the log does not reach that far."""
    period = _period_deg(missing.best.fit, family)
    return period if law.x[-1] - law.x[0] >= _SEEN_AGAIN * period else 0.0


def _more_of(law: Law, course: str, before: int) -> str:
    """A sentence on a law beside the leading one, or on its factor.

    Args:
      before: laws that were told before, without the leading one.
    """
    of = VARIABLES[law.variable]
    if law.multiplies:
        return f"It is multiplied by a factor that depends on {of}: {course}."
    which = "Another" if before == 0 else "Yet another"
    return f"{which} law is needed as well, {PLACES[law.place]}; it depends on {of}: {course}."


def _likeness(law: Law, *, alone: bool) -> str:
    """The plain law that the curve resembles; empty: none.

    Args:
      alone: whether no other law is told beside it.
    """
    like = likeness_of(law)
    if like is None or like.shape == LEVEL:  # that a band hides everything is no law
        return ""
    library = f", as {' and '.join(like.library)} in the library" if like.library else ""
    library += "; what the library lacks is what acts beside it" if like.library and not alone else ""
    article = "an" if like.shape[0] in "aeiou" else "a"
    how = "is fitted as" if law.shape else "looks like"
    which = "The law" if alone else "The first law"
    return f" {which} {how} {article} {like.shape}{library}: {like.says}."


def next_step(missing: Missing) -> str:
    """What to do next, as an instruction; empty: there is no law to check."""
    if missing.law is None:
        return ""
    law = missing.law
    check = check_of(law.place, law.variable, of_a_clock=law.of_a_clock)
    if not missing.closed:
        return f"{check}; the law leaves more than noise, so examine the remaining residual next"
    if not can_be_saved(missing):
        return check
    return f"{check}; if it comes out the same, save the law as an effect (--save-effect NAME)"


def _period_deg(fit: Fit, family: Family) -> float:
    if family.x_unit != "deg":
        return 0.0
    own = zip(fit.parameterization.values(fit.x), fit.parameterization.owners, strict=True)
    values = [float(value) for value, owner in own if owner == family.name]
    free = family.effect.apply(RigParameters(), *values).free or FreeLaw()
    laws = (*free.throughout, *free.at_tip, *free.at_entry, *free.in_sheath)
    cycles = [law.orientation_cycles for law in laws if _has_waves(law)]
    whole = all(own.is_integer() for own in cycles)  # else over many turns
    waves = [_TURN_DEG / own for own in cycles if whole]
    curves = (curve.period for curve in free.curves if curve.variable is not Variable.TIME)
    return max([*curves, *waves], default=0.0)


def _has_waves(law: Interface) -> bool:
    """Whether a torque or a dry friction of a law repeats over the angle of the shaft."""
    return bool(law.orientation_n_mm_per_mm or law.orientation_dry_n_mm_per_mm)


def repeating(period_deg: float) -> str:
    """That a law repeats itself, as the end of a sentence; empty: it does not."""
    return f", and repeats every {period_deg:.4g} deg" if period_deg else ""


def _beside(missing: Missing) -> str:
    """The gaps that laws of other variables leave, if they were fitted to the same samples."""
    told = {law.variable for law in missing.beside}
    rest = [d for d in missing.depends_on[1:] if d.variable not in told]
    others = [d for d in rest if not d.decimated and d.gap_after < float("inf")][:_OTHERS]
    each = ", ".join(f"{in_sigma(d.gap_after)} with {VARIABLES[d.variable]}" for d in others)
    return f"; the best laws of other variables leave {each}" if each else ""
