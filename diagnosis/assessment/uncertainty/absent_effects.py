"""Effects of a verdict that may as well be absent: their intervals reach it.

The score of an explanation knows white noise. The intervals of its parameters also know what the
noise of the base encoder and the error of the replay do. Where the interval of an effect's strength
reaches the value at which there is no effect, the explanation without it says the same, and more
simply; but where that was refused, it is open. And so it is where nothing but a filter of a sensor is
left, which may be a delay, if that was not refused. A time below a small share of a sample is none: no
replay resolves it.
"""

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.criteria.assessment import RESOLVED_SHARE_OF_SAMPLE
from diagnosis.effects.effect import Parameter
from diagnosis.selection.verdicts.delay_or_filter import delays_in_place
from diagnosis.selection.verdicts.ranking import NOTHING
from diagnosis.selection.verdicts.verdict import Verdict, VerdictKind

_ROUNDING = 1e-9
"""Of a bound that was fitted in its logarithm."""


def without_absent(
    verdict: Verdict,
    parameters: Mapping[str, Mapping[str, Interval]],
    sample_s: float,
    refused: Collection[frozenset[str]] = (),
) -> Verdict:
    """The verdict without effects that may as well be absent; what was told stays confusable.

    One that was undecided only between them and their absence is decided.

    Args:
      parameters: intervals by effect and parameter.
      sample_s: time between samples.
      refused: sets of effects that do not explain the log.
    """
    own = verdict.best.fit.parameterization
    each = list(zip(own.owners, own.parameters, strict=True))
    absent = {
        name
        for name in verdict.effects
        if _may_be_absent([p for owner, p in each if owner == name], parameters.get(name, {}), sample_s)
    }
    if not absent:
        return verdict
    told, left = verdict.effects, tuple(name for name in verdict.effects if name not in absent)
    others = [names for names in verdict.confusable if set(names) not in (set(told), set(left))]
    late = (
        [] if left else [(n,) for n in delays_in_place(verdict.best) if frozenset((n,)) not in refused]
    )
    others += [names for names in late if names not in others]
    kind, doubtful = verdict.kind, frozenset(left) in refused
    if kind is VerdictKind.EXPLAINED and (late or (left and doubtful)):
        kind = VerdictKind.UNDECIDED
    elif kind is VerdictKind.EXPLAINED or not (others or doubtful):
        kind = VerdictKind.EXPLAINED if left else VerdictKind.NONE
    return replace(
        verdict,
        kind=kind,
        effects=left,
        confusable=(left, told, *others),
        ranking=_exchanged(verdict.ranking, told, left),
    )


def _may_be_absent(
    parameters: Sequence[Parameter], own: Mapping[str, Interval], sample_s: float
) -> bool:
    """Whether every parameter of strength has an interval that reaches the value of no effect."""
    sizes = [p for p in parameters if p.name in own and p.neutral is not None]
    return bool(sizes) and all(_reaches_neutral(p, own[p.name], sample_s) for p in sizes)


def _reaches_neutral(parameter: Parameter, interval: Interval, sample_s: float) -> bool:
    if parameter.unit == "s" and parameter.neutral == 0.0:
        return interval.low <= RESOLVED_SHARE_OF_SAMPLE * sample_s
    if parameter.neutral == math.inf:
        return interval.high >= parameter.high * (1 - _ROUNDING)
    if parameter.logarithmic and parameter.neutral == 0.0:
        return interval.low <= parameter.low * (1 + _ROUNDING)
    return interval.low <= float(parameter.neutral or 0.0) <= interval.high


def _exchanged(
    ranking: tuple[tuple[tuple[str, ...], float], ...], one: tuple[str, ...], other: tuple[str, ...]
) -> tuple[tuple[tuple[str, ...], float], ...]:
    """The ranking with the probabilities of two sets exchanged."""
    shares = dict(ranking)
    a, b = (tuple(sorted(names)) or (NOTHING,) for names in (one, other))
    shares[a], shares[b] = shares.get(b, 0.0), shares.get(a, 0.0)
    return tuple(sorted(shares.items(), key=lambda item: -item[1]))
