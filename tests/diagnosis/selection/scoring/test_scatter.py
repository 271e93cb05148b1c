"""What a fit tells of stiffness and damping: against integrals over a likelihood, by quadrature."""

import numpy as np
import pytest
from diagnosis_fixtures import fit_of
from scipy.stats import norm

from diagnosis.criteria.fitting import EXACT, SCATTER
from diagnosis.effects import LIBRARY
from diagnosis.selection.candidate import candidate
from diagnosis.selection.scoring.complexity import complexity_penalty
from diagnosis.selection.scoring.scatter import gain_of_exact_constants, open_scatter, scatter_of

BOTH = tuple(LIBRARY[name] for name in SCATTER)
SIGMAS = np.array(list(SCATTER.values()))


def linear_fit(told, true, nuisance=BOTH):
    """A fit to readings whose likelihood is exp(-(x - true)' told (x - true) / 2), and its x."""
    slopes = np.linalg.cholesky(np.asarray(told, float)).T
    readings, prior = slopes @ true, np.diag(SIGMAS[: len(nuisance)] ** -2.0)
    x = np.linalg.solve(told + prior, told @ true)
    return fit_of((), by_trial=[slopes @ x - readings], jacobian=[slopes], x=x, nuisance=nuisance)


def evidence(told, true, sigmas):
    """The integral of likelihood times prior, by the trapezoidal rule on 2001 x 2001 points."""
    x = np.linspace(-8, 8, 2001)
    away = np.stack(np.meshgrid(sigmas[0] * x, sigmas[1] * x, indexing="ij")) - true[:, None, None]
    likelihood = np.exp(-0.5 * np.einsum("iab,ij,jab->ab", away, told, away))
    return float(norm.pdf(x) @ likelihood @ norm.pdf(x)) * (x[1] - x[0]) ** 2


@pytest.mark.parametrize("true", [(0.0, 0.0), (0.002, 0.0), (0.004, -0.006), (0.02, 0.0)])
@pytest.mark.parametrize("correlation", [0.0, 0.9])
def test_the_gain_is_that_of_integrals_over_the_likelihood(true, correlation):
    """Up to the weak ridge of the fit, which widens nothing here."""
    spread = 0.003**2 * np.array([[1.0, correlation], [correlation, 1.0]])
    told = np.linalg.inv(spread)
    odds = evidence(told, np.array(true), np.full(2, EXACT)) / evidence(told, np.array(true), SIGMAS)
    gain = gain_of_exact_constants(linear_fit(told, np.array(true)))
    assert gain == pytest.approx(2 * np.log((1 + odds) / 2), abs=1e-3)


def test_exact_constants_that_the_data_tell_well_gain_nearly_all_there_is():
    """With data far sharper than both priors: log(SCATTER / EXACT) for each constant, twice."""
    most = 2 * np.log(SIGMAS / EXACT).sum() - 2 * np.log(2)
    gain = gain_of_exact_constants(linear_fit(np.eye(2) * 1e10, np.zeros(2)))
    assert most - 0.1 < gain < most + 0.01


def test_constants_that_are_off_or_that_nothing_tells_gain_nothing():
    off = linear_fit(np.eye(2) * 1e8, np.array([0.02, 0.0]))
    assert gain_of_exact_constants(off) == pytest.approx(-2 * np.log(2), abs=1e-6)
    blind = linear_fit(np.eye(2) * 1e-3, np.zeros(2))
    assert gain_of_exact_constants(blind) == pytest.approx(0.0, abs=1e-4)


def test_only_what_the_fit_adjusts_counts():
    named = fit_of(("stiffness_error",), nuisance=BOTH)
    assert open_scatter(named) == ["damping_error"]
    assert gain_of_exact_constants(fit_of(("tip_drag",))) == 0.0
    away, spread = scatter_of(linear_fit(np.eye(1) * 1e6, np.array([0.003]), BOTH[:1]))
    known = 1e6 + SIGMAS[0] ** -2
    assert away == pytest.approx([1e6 * 0.003 / known])
    assert spread == pytest.approx(np.array([[1 / known]]), rel=1e-6)


def test_the_score_of_a_candidate_is_less_by_the_gain():
    fit = linear_fit(np.eye(2) * 1e8, np.zeros(2))
    wanted = fit.cost + complexity_penalty(fit) - gain_of_exact_constants(fit)
    assert candidate(fit).score == pytest.approx(wanted)
