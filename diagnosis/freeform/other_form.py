"""Whether a law that explains a log has another form in truth.

Two layers of tissue are an idealisation: damping that changes evenly along the shaft looks much like
them, and may be left at the noise floor. Evenly elastic tissue and a little drift of the torque sensor
may look like tissue that is stiffer further in. So an effect may name free-form laws of its kind
(`Effect.other_forms`). Each is fitted in place of the effect, on the decimated log; and where it leaves
clearly less, on the log itself. If it leaves less there too, the effect explains nothing. Nor does it if
the law alone leaves about as little as the effect together with others: these only compensated for its
wrong form. (Stiffness and damping do not count as such others, because every fit has them, unless they
are off by too much: elastic tissue and these two together imitate a gain of the torque sensor. Nor does
dry friction count against a curve over the rate, which has it for a part.)

A law that has the parameters of the effect, and a curve besides, or a curve that may be that of the
effect, starts where the effect is. Then a single step shows whether it promises anything.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.fitting import SCATTER
from diagnosis.criteria.freeform import OTHER_FORM_PROMISING
from diagnosis.criteria.selection import SECOND_LEAVES
from diagnosis.effects import IMPERFECTIONS, LIBRARY
from diagnosis.effects.effect import Parameter
from diagnosis.fitting.decimation import decimated
from diagnosis.fitting.fit import Fit, fit_effects
from diagnosis.fitting.fit_status import Termination
from diagnosis.fitting.noise_floor import floor_of
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.families import families_of
from diagnosis.freeform.family import REST, STRAIGHT, Family
from diagnosis.freeform.fits.free_fit import with_family
from diagnosis.freeform.fits.full_fit import ITERATIONS
from diagnosis.freeform.missing.words import VARIABLES
from diagnosis.freeform.ranges import ranges_of
from diagnosis.nominal_replay import NominalReplay
from diagnosis.replay.replay import replay
from diagnosis.selection.candidate import candidate
from diagnosis.workers import Task, Workers

Array = NDArray[np.float64]

STAGE = "other forms of a law"
_NEARLY_STRAIGHT = {STRAIGHT: 0.5, REST: 0.1}  # priors of the parts of a curve
_WEAK = 0.05  # times the first start of a level


@dataclass(frozen=True, kw_only=True, eq=False)
class OtherForm:
    """A free-form law that refutes an explanation.

    Attributes:
      leaves: how it does, in words.
    """

    family: Family
    leaves: str

    @property
    def in_words(self) -> str:
        """The law and how it refutes, as the end of a sentence."""
        return f"{self.family.title} that depends on {VARIABLES[self.family.says]} {self.leaves}"


def other_form(nominal: NominalReplay, best: Fit, workers: Workers) -> OtherForm | None:
    """The free-form law that refutes an effect of an explanation; None: there is none.

    Args:
      nominal: the log as it was replayed first, without drift of the sensors.
      best: the explanation.

    Raises:
      SimulationFailed: the nominal rig cannot be simulated on the decimated log.
    """
    asked = {form: name for name in best.names if name in LIBRARY for form in LIBRARY[name].other_forms}
    if not asked:
        return None
    problem = nominal.problem
    coarse = decimated(problem, nominal.predictions, nominal.rig)
    ranges = ranges_of(coarse, replay(coarse.log, resolution=coarse.resolution))
    families = [f for f in families_of(ranges) if f.name in asked]
    tasks = [
        Task(effects=(f.name,), arguments=(problem, coarse, best, asked[f.name], f)) for f in families
    ]
    each = zip(families, workers.each(STAGE, _how_it_refutes, tasks), strict=True)
    found = (OtherForm(family=f, leaves=how) for f, how in each if isinstance(how, str) and how)
    return next(found, None)


def _how_it_refutes(
    problem: FitProblem, coarse: FitProblem, best: Fit, name: str, family: Family
) -> str:
    """How a family in place of an effect, at the noise floor, refutes it, in words; empty: it does not.

    Without imperfections and drift of sensors on either side, which may compensate for a wrong form;
    where the explanation with its imperfections leaves clearly less still, they did not.
    """
    plain = tuple(n for n in best.names if n not in IMPERFECTIONS)
    others = tuple(n for n in plain if n != name)
    known = _from(best, plain, coarse)
    fits = _Comparison(
        problem=problem, coarse=coarse, best=best, known=known, family=family, replaced=name
    )
    alone = (*(n for n in others if n in SCATTER), family.name)
    compensated = len(alone) <= len(others) and not set(others) & set(family.contains)
    if compensated and fits.leaves(alone, 1 / SECOND_LEAVES, fewer=True):
        return "leaves about as little alone"
    return "leaves clearly less" if fits.leaves((*others, family.name), SECOND_LEAVES) else ""


@dataclass(frozen=True, kw_only=True, eq=False)
class _Comparison:
    """A family in place of an effect of an explanation.

    Attributes:
      best: the explanation.
      known: the same without imperfections of sensors, fitted to the decimated log.
      replaced: the effect.
    """

    problem: FitProblem
    coarse: FitProblem
    best: Fit
    known: Fit
    family: Family
    replaced: str

    def leaves(self, names: tuple[str, ...], share: float, *, fewer: bool = False) -> bool:
        """Whether a set with the family is at the floor, and leaves at most a share of the cost.

        Args:
          fewer: whether it has to need fewer effects.
        """
        form = self._on_the_decimated_log(names, share * self.known.cost)
        if form is None or form.cost > share * self.known.cost:
            return False
        known = _from(self.known, self.known.names, self.problem)
        form = _from(form, names, with_family(self.problem, self.family))
        if form.cost >= share * known.cost or not floor_of(form.by_trial).small:
            return False
        if fewer and _needs(form) >= _needs(known):
            return False
        return form.cost < self._whole(known).cost / SECOND_LEAVES

    def _whole(self, known: Fit) -> Fit:
        """The explanation with its imperfections of sensors, on the log itself."""
        if len(self.best.names) == len(known.names):
            return known
        return _from(self.best, self.best.names, self.problem)

    def _on_the_decimated_log(self, names: tuple[str, ...], enough: float) -> Fit | None:
        """A fit from where the explanation is; None: it cannot come near enough."""
        # From far off a fit may end in a local minimum; another one begins with a nearly straight curve.
        straight = with_family(self.coarse, self.family.with_prior(_NEARLY_STRAIGHT))
        own = with_family(self.coarse, self.family)
        begun = {self.family.name: _begun(self.known, self.coarse, self.replaced, self.family)}
        if len(names) == len(self.known.names) and self._starts_as_the_effect():
            form = _from(self.known, names, straight, begun, iterations=1)
            return (
                None if form.cost > OTHER_FORM_PROMISING * self.known.cost else _from(form, names, own)
            )
        form = _from(self.known, names, own, begun, enough=enough)
        if form.cost <= enough:
            return form
        form = _from(self.known, names, straight, begun, enough=enough)
        behind = form.status.termination is Termination.BEHIND
        return None if behind else _from(form, names, own, enough=enough)

    def _starts_as_the_effect(self) -> bool:
        """Whether the law has the parameters of the effect, or a curve that may be its curve."""
        own = {parameter.name for parameter in self.coarse.library[self.replaced].parameters}
        places = {parameter.name for parameter in self.family.effect.parameters}
        return self.replaced in self.family.as_effect or own <= places


def _needs(fit: Fit) -> int:
    """The number of its effects, with stiffness and damping where they are off by too much."""
    return len(fit.names) + len(candidate(fit).scatter_named)


def _begun(known: Fit, problem: FitProblem, name: str, family: Family) -> Array:
    """The family's part of a vector, which is the effect as fitted, as far as it can be."""
    own, parameters = problem.library[name].parameters, family.effect.parameters
    if name in family.as_effect:
        fitted = [p.from_fit(float(x)) for p, x in zip(own, known.parts[name], strict=True)]
        values = family.as_effect[name](*fitted)
        return np.array([p.to_fit(v) for p, v in zip(parameters, values, strict=True)])
    same = dict(zip([p.name for p in own], known.parts[name], strict=True))
    return np.array([same.get(p.name, _neutral(p)) for p in parameters])


def _neutral(parameter: Parameter) -> float:
    """Where a level is hardly felt, and a curve is straight."""
    first = parameter.start[0]
    return parameter.to_fit(_WEAK * first if parameter.logarithmic else first)


def _from(
    near: Fit,
    names: tuple[str, ...],
    problem: FitProblem,
    parts: Mapping[str, Array] = MappingProxyType({}),
    *,
    iterations: int = ITERATIONS,
    enough: float = np.inf,
) -> Fit:
    """A fit that starts where another one is, with other parts of the vector where they are given."""
    start = problem.parameterization(names).joined({**near.parts, **parts})
    return fit_effects(problem, names, start, most_iterations=iterations, enough=enough)
