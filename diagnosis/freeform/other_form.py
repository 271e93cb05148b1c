"""Whether a law that explains a log has another form in truth.

Two layers of tissue are an idealisation: damping that changes evenly along the shaft looks much like
them, and may be left at the noise floor. So an effect may name free-form laws of its kind
(`Effect.other_forms`). Each is fitted in place of the effect, on the decimated log; and where it leaves
clearly less, on the log itself. If it leaves less there too, the effect explains nothing.
"""

from diagnosis.criteria import SECOND_LEAVES
from diagnosis.effects import IMPERFECTIONS, LIBRARY
from diagnosis.fitting.decimation import decimated
from diagnosis.fitting.fit import Fit, fit_effects
from diagnosis.fitting.noise_floor import floor_of
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.families import families_of
from diagnosis.freeform.family import Family
from diagnosis.freeform.ranges import ranges_of
from diagnosis.freeform.search import ITERATIONS, with_family
from diagnosis.nominal_replay import NominalReplay
from diagnosis.replay.replay import replay
from diagnosis.workers import Failure, Task, Workers

STAGE = "other forms of a law"
_NEARLY_STRAIGHT = (0.5, 0.1)  # priors of a curve's straight part and its rest


def other_form(nominal: NominalReplay, best: Fit, workers: Workers) -> Family | None:
    """The free-form law that leaves clearly less than an effect of an explanation; None: there is none.

    Args:
      nominal: the log as it was replayed first, without drift of the torque.
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
    each = zip(families, workers.each(STAGE, _leaves_less, tasks), strict=True)
    return next((f for f, less in each if less and not isinstance(less, Failure)), None)


def _leaves_less(problem: FitProblem, coarse: FitProblem, best: Fit, name: str, family: Family) -> bool:
    """Whether a family is at the noise floor in place of an effect, and leaves clearly less.

    Without imperfections and drift of sensors on either side, which may have been a crutch of it.
    """
    plain = tuple(n for n in best.names if n not in IMPERFECTIONS)
    names = (*(n for n in plain if n != name), family.name)
    known = _from(best, plain, coarse)
    straight = family.with_prior(*_NEARLY_STRAIGHT)  # from far off a fit may end in a local minimum
    form = _from(known, names, with_family(coarse, straight))
    form = _from(form, names, with_family(coarse, family))
    if form.cost > SECOND_LEAVES * known.cost:
        return False
    known = _from(known, plain, problem)
    form = _from(form, names, with_family(problem, family))
    return form.cost < SECOND_LEAVES * known.cost and floor_of(form.by_trial).small


def _from(near: Fit, names: tuple[str, ...], problem: FitProblem) -> Fit:
    """A fit that starts where another one is."""
    start = problem.parameterization(names).joined(near.parts)
    return fit_effects(problem, names, start, most_iterations=ITERATIONS)
