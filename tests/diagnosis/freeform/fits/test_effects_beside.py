"""Which effects are worth a fit beside a free-form law."""

import numpy as np
import pytest
from free_forms import CURVE, family_of, linear_fit, one_trial

from diagnosis.fitting.fit import fit_effects
from diagnosis.freeform.fits import effects_beside
from diagnosis.freeform.fits.effects_beside import pairs_beside, predicted_costs
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.selection.screening import Screened
from diagnosis.workers import Workers

SAMPLES = 300
EYE = np.eye(CURVE.size)


@pytest.fixture
def law():
    """A law, what it leaves of readings with an effect, and what changes by effects do to them."""
    rng = np.random.default_rng(5)
    slopes = rng.normal(size=(SAMPLES, CURVE.size))
    changes = rng.normal(size=(SAMPLES, 3))
    changes[:, 2] = slopes @ rng.normal(size=CURVE.size)  # nothing that the law could not do itself
    readings = (
        slopes @ rng.normal(size=CURVE.size) - 0.8 * changes[:, 0] + 0.1 * rng.normal(size=SAMPLES)
    )
    return linear_fit(family_of(), [slopes], [-readings]), changes


def test_the_promise_is_the_cost_of_a_common_fit_where_both_are_linear(law):
    """Least squares of both together, the prior of the law included, is the oracle."""
    fit, changes = law
    costs = predicted_costs(fit, changes)
    for k, change in enumerate(changes.T[:2]):
        both = np.column_stack([fit.slopes, np.pad(change, (0, CURVE.size))])
        left, amount = _least_squares(both, -fit.residual)
        oracle = left if amount > 0 else _least_squares(fit.slopes, -fit.residual)[0]
        assert costs[k] == pytest.approx(oracle, rel=1e-9)


def _least_squares(system, wanted):
    found, *_ = np.linalg.lstsq(system, wanted, rcond=None)
    return float(np.sum((system @ found - wanted) ** 2)), found[-1]


def test_what_the_law_can_do_itself_promises_nothing(law):
    fit, changes = law
    costs = predicted_costs(fit, changes)
    assert costs[2] > 0.9 * fit.cost
    assert costs[0] < 0.1 * fit.cost


@pytest.fixture
def screened(monkeypatch):
    """The pairs of laws whose promises are what they leave, best first, and all that are simulated."""
    problem, _ = one_trial(np.linspace(0, 90, 200), tip=np.zeros(200))
    base, seen = fit_effects(problem, ()), []

    def run(costs, failing=()):
        names = {law for law, _ in costs}
        effects = sorted({effect for _, effect in costs})
        families = [family_of(name=name) for name in sorted(names)]
        fits = [linear_fit(family, [EYE], [np.ones(CURVE.size)]) for family in families]
        laws = [FreeFit(family=f, fit=fit) for f, fit in zip(families, fits, strict=True)]

        def simulated(_, law, name):
            seen.append((law.family.name, name))
            cost = costs[law.family.name, name]
            return Screened(names=(law.family.name, name), start=np.zeros(2), cost=cost, gain=0.0)

        def promised(fit, _):
            (law,) = fit.names
            return np.array([costs[law, name] for name in effects if name not in failing])

        monkeypatch.setattr(effects_beside, "_screened_beside", simulated)
        monkeypatch.setattr(effects_beside, "_changes", lambda *_: np.zeros((SAMPLES, 1)))
        monkeypatch.setattr(effects_beside, "predicted_costs", promised)
        pairs = pairs_beside(problem, problem, base, laws, effects, Workers())
        return [(law.family.name, s.names[-1]) for law, s in pairs]

    return run, seen


def test_pairs_that_promise_most_are_simulated_and_of_these_the_best_go_on_few_of_one_law(screened):
    run, seen = screened
    costs = {(f"law {i}", f"effect {k}"): 10.0 * i + k for i in range(12) for k in range(8)}
    found = run(costs)
    assert len(seen) == effects_beside.SIMULATED
    assert all(sum(law == one for one, _ in seen) <= effects_beside.SIMULATED_OF_ONE for law, _ in seen)
    assert found == [
        (f"law {i}", f"effect {k}") for i in range(3) for k in range(effects_beside.PAIRS_OF_ONE)
    ]
    assert len(found) == effects_beside.PAIRS


def test_without_effects_there_are_no_pairs(screened):
    run, _ = screened
    assert run({}) == []
