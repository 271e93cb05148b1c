"""`needle diagnose --paper`: everything that is run, stage by stage."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from studies.published.compensator import Compensated, compensated
from studies.published.experiments.figures import Figure, gelatin, plastisol
from studies.published.experiments.replay import Replay
from studies.published.experiments.rig import PaperRig
from studies.published.fitting.fit import Fit, Fitter
from studies.published.fitting.hypothesis import Hypothesis
from studies.published.fitting.mechanisms import OF_GELATIN
from studies.published.selection import hypothesis_set as tried
from studies.published.selection.attainability import out_of_reach
from studies.published.selection.discrimination import IN_WORDS, IN_WORDS_OF_GELATIN, Prospect, prospects
from studies.published.selection.verdict import Verdict, judge

Progress = Callable[[str, float], None]


@dataclass(frozen=True, kw_only=True)
class InWords:
    """What the text says of a figure, and what accepted fits make of it, in their order."""

    figure: Figure
    stated: float
    predicted: tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class Case:
    """One material: its figures, the stated rig, all fits, and the verdict.

    Attributes:
      stated: the stated rig in each of its readings.
      fits: single effects, then pairs, each in the order of AICc.
      beyond: figures that a single candidate cannot close at any strength.
    """

    material: str
    figures: tuple[Figure, ...]
    stated: tuple[Fit, ...]
    fits: tuple[Fit, ...]
    beyond: dict[Hypothesis, tuple[Figure, ...]]
    verdict: Verdict
    in_words: tuple[InWords, ...]


@dataclass(frozen=True, kw_only=True)
class Study:
    """Everything that was found.

    Attributes:
      prospects: further experiments with plastisol, by how many hypotheses they tell apart.
      warnings: of fits whose simulation is doubtful.
    """

    plastisol: Case
    gelatin: Case
    compensated: tuple[Compensated, ...]
    prospects: tuple[Prospect, ...]
    warnings: tuple[str, ...]


def run_study(progress: Progress = lambda what, share: None) -> Study:
    """Run everything; about a minute on one core.

    Args:
      progress: called with what begins and the share that is done.

    Raises:
      SimulationFailed: a rig cannot be simulated.
    """
    replay = Replay()
    progress("gelatin", 0.0)
    held = _gelatin(replay)
    turned = _plastisol(replay, progress)
    progress("the compensator's columns", 0.93)
    columns = compensated()
    return Study(
        plastisol=turned,
        gelatin=held,
        compensated=columns,
        prospects=tuple(prospects(turned.verdict.accepted, replay)),
        warnings=_warnings((*held.fits, *turned.fits), replay),
    )


def _warnings(fits: Sequence[Fit], replay: Replay) -> tuple[str, ...]:
    doubtful = [(f.hypothesis, replay.unconverged(f.hypothesis.rig(f.x))) for f in fits]
    return tuple(
        f"{' and '.join(h.names)}: {stages} stages of its simulation did not converge"
        for h, stages in doubtful
        if stages
    )


def _gelatin(replay: Replay) -> Case:
    fitter = Fitter(gelatin(), replay)
    stated = (fitter.fit(tried.stated(PaperRig())),)
    fits = sorted((fitter.fit(tried.of_gelatin(name)) for name in OF_GELATIN), key=_order)
    verdict = judge(stated, fits)
    return Case(
        material="gelatin",
        figures=fitter.figures,
        stated=stated,
        fits=tuple(fits),
        beyond={},
        verdict=verdict,
        in_words=_in_words(IN_WORDS_OF_GELATIN, stated[0], verdict, replay),
    )


def _plastisol(replay: Replay, progress: Progress) -> Case:
    fitter = Fitter(plastisol(), replay)
    stated = tuple(fitter.fit(tried.stated(base)) for base in tried.READINGS)
    alone: list[Fit] = []
    known: dict[PaperRig, Fit] = {}
    beyond: dict[Hypothesis, tuple[Figure, ...]] = {}
    wanted = tried.singles()
    for i, one in enumerate(wanted):
        progress(f"{one.names[0]}, {one.reading}", 0.05 + 0.45 * i / len(wanted))
        starts = tried.starts_alone(one, known[one.base]) if one.base in known else ()
        alone.append(fitter.fit(one, starts))
        known.setdefault(one.base, alone[-1])  # the damping alone comes first
        beyond[one] = _beyond(alone[-1], beyond, replay)
    both = _pairs(fitter, alone, progress)
    fits = (*sorted(alone, key=_order), *sorted(both, key=_order))
    verdict = judge(stated, fits)
    return Case(
        material="plastisol",
        figures=fitter.figures,
        stated=stated,
        fits=fits,
        beyond=beyond,
        verdict=verdict,
        in_words=_in_words(IN_WORDS, stated[0], verdict, replay),
    )


def _beyond(fit: Fit, known: dict[Hypothesis, tuple[Figure, ...]], replay: Replay) -> tuple[Figure, ...]:
    """What a candidate cannot close; it can whatever one that it contains can."""
    simpler = [
        known[h]
        for name in fit.hypothesis.candidates[-1].contains
        for h in known
        if h.names == (name,) and h.base == fit.hypothesis.base
    ]
    return tuple(f for f in out_of_reach(fit, replay) if all(f in beyond for beyond in simpler))


def _pairs(fitter: Fitter, alone: Sequence[Fit], progress: Progress) -> list[Fit]:
    known = {(f.hypothesis.base, f.hypothesis.names[0]): f for f in alone}
    wanted, found = tried.pairs(alone), []
    for i, pair in enumerate(wanted):
        progress(" and ".join(pair.names), 0.5 + 0.43 * i / len(wanted))
        single = {n: known[pair.base, n] for n in pair.names if (pair.base, n) in known}
        found.append(fitter.fit(pair, tried.starts_of_pair(pair, single)))
    return found


def _order(fit: Fit) -> tuple[float, float]:
    return fit.aicc, fit.chi_square


def _in_words(
    figures: Sequence[Figure], stated: Fit, verdict: Verdict, replay: Replay
) -> tuple[InWords, ...]:
    fits = (stated, *(verdict.accepted or (verdict.best,)))
    predicted = replay(figures, [f.hypothesis.rig(f.x) for f in fits])
    return tuple(
        InWords(figure=figure, stated=float(row[0]), predicted=tuple(map(float, row[1:])))
        for figure, row in zip(figures, predicted, strict=True)
    )
