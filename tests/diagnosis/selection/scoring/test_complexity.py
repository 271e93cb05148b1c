"""What an explanation has to take off the cost to be worth its freedom: against integrals."""

import math

import numpy as np
import pytest
from diagnosis_fixtures import fit_of

from diagnosis.criteria.fitting import SCATTER
from diagnosis.effects import FITTED, LIBRARY
from diagnosis.selection.scoring.complexity import choice_penalty, complexity_penalty, most_penalty

COUNT = len(FITTED)
SAMPLES = 3000
SCALE = LIBRARY["damping_error"]


def fit_with(names, known, nuisance=()):
    """A fit whose readings tell of its vector what a matrix says, (n, n): J'J."""
    roots = np.linalg.cholesky(np.asarray(known, float) + 1e-30 * np.eye(len(known))).T
    slopes = np.vstack([roots, np.zeros((SAMPLES - len(known), len(known)))])
    x = np.zeros(len(known))
    return fit_of(names, by_trial=[np.zeros(SAMPLES)], jacobian=[slopes], x=x, nuisance=nuisance)


def width(name):
    parameter = LIBRARY[name].parameters[0]
    return parameter.to_fit(parameter.high) - parameter.to_fit(parameter.low)


@pytest.mark.parametrize(
    ("names", "choices"),
    [
        ((), 1),
        (("tip_drag",), COUNT),
        (("stiction",), COUNT),
        (("stiction", "tip_drag"), COUNT * (COUNT - 1) / 2),
    ],
)
def test_what_is_told_sharply_costs_a_logarithm_and_so_does_the_choice(names, choices):
    entries = sum(len(FITTED[n].parameters) for n in names)
    known = 1e9 * np.eye(entries)
    expected = entries * math.log(1 + SAMPLES) + 2 * math.log(choices)
    fit = fit_with(names, known) if entries else fit_of(())
    assert complexity_penalty(fit) == pytest.approx(expected, abs=0.01)
    assert most_penalty(names, SAMPLES) == pytest.approx(expected)


def test_what_the_data_do_not_tell_costs_nothing_but_the_choice():
    idle = complexity_penalty(fit_with(("layered_tissue",), np.diag([1e9, 0.0])))
    assert idle - 2 * math.log(COUNT) == pytest.approx(math.log(1 + SAMPLES), abs=0.01)
    assert complexity_penalty(fit_with(("tip_drag",), [[0.0]])) == pytest.approx(
        choice_penalty(("tip_drag",))
    )


def test_what_contains_a_simpler_effect_costs_a_logarithm_for_each_parameter():
    """Where it looks like the simpler one, the data never tell its shape."""
    fit = fit_with(("stiction",), np.diag([1e9, 1e9, 0.0]))
    assert complexity_penalty(fit) == pytest.approx(most_penalty(("stiction",), SAMPLES))


def test_what_is_not_reported_costs_nothing():
    """Where the plateau of shear thinning begins is open and not told."""
    fit = fit_with(("shear_thinning",), 1e9 * np.eye(2))
    expected = math.log(1 + SAMPLES) + 2 * math.log(COUNT)
    assert complexity_penalty(fit) == pytest.approx(expected, abs=0.01)


@pytest.mark.parametrize("sigma", [0.01, 0.3, 3.0])
@pytest.mark.parametrize("correlation", [0.0, 0.99])
def test_it_is_the_share_of_the_prior_that_the_data_leave(sigma, correlation):
    """With a likelihood of two parameters, one of them open: the integral over both, by the rule of the
    rectangle, over that of the likelihood with the effect's own parameter held where it is best."""
    spread = np.diag([sigma, 0.01])
    known = np.linalg.inv(spread @ [[1.0, correlation], [correlation, 1.0]] @ spread)
    prior = 12 / width("tip_drag") ** 2 + known[0, 0] / SAMPLES
    own = np.linspace(-10, 10, 4001) * sigma
    other = np.linspace(-10, 10, 4001) * 0.01
    alone = (known[1, 1] + SCATTER["damping_error"] ** -2) * other**2
    cost = known[0, 0] * own[:, None] ** 2 + 2 * known[0, 1] * own[:, None] * other + alone
    weight = np.sqrt(prior / (2 * np.pi)) * np.exp(-0.5 * prior * own**2) * (own[1] - own[0])
    left = (weight @ np.exp(-0.5 * cost)).sum() / np.exp(-0.5 * alone).sum()
    found = complexity_penalty(fit_with(("tip_drag",), known, (SCALE,))) - choice_penalty(("tip_drag",))
    assert found == pytest.approx(-2 * math.log(left), abs=0.02)


def test_no_set_costs_more_than_if_all_of_it_were_told():
    rng = np.random.default_rng(3)
    names = ("layered_tissue", "tip_drag")
    for _ in range(50):
        slopes = rng.normal(size=(4, 4)) * 10.0 ** rng.uniform(-3, 4, 4)
        penalty = complexity_penalty(fit_with(names, slopes.T @ slopes, (SCALE,)))
        assert choice_penalty(names) - 1e-6 <= penalty <= most_penalty(names, SAMPLES) + 1e-6


def test_nothing_is_likelier_than_anything_before_the_data():
    """Without data, odds of all effects together are those of none: their number takes it back."""
    one = complexity_penalty(fit_with(("tip_drag",), [[0.0]]))
    assert COUNT * math.exp(-0.5 * one) == pytest.approx(1.0)
