"""Laws that leave the same count once."""

from dataclasses import replace

import numpy as np
from free_forms import family_of, linear_fit

from diagnosis.freeform.fits import together
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.fits.together import distinct, unlike
from diagnosis.workers import Workers

EYE = np.eye(8)


def fit_of(name, left):
    family = family_of(name=name)
    fit = linear_fit(family, [EYE], [np.zeros(8)], x=np.zeros(8))
    left = np.asarray(left, float)
    return FreeFit(family=family, fit=replace(fit, by_trial=(left,), cost=float(left @ left)))


def test_of_laws_whose_variables_are_the_same_in_a_log_the_first_stays():
    """They leave the same; as large is not the same."""
    slid, pushed = (fit_of(name, [1.0, 2.0]) for name in ("slid lately", "pushed lately"))
    turned, else_ = fit_of("turned", [2.0, 1.0]), fit_of("else", [1.0, 2.1])
    assert unlike([slid, pushed, turned, else_]) == [slid, turned, else_]


def test_of_a_law_the_best_fit_stays():
    first, again = fit_of("slid", [1.0, 2.0]), fit_of("slid", [1.0, 3.0])
    other = fit_of("turned", [5.0, 2.0])
    assert distinct([first, other, again]) == [first, other]


def test_a_third_law_stands_beside_the_best_pairs_alone(monkeypatch):
    """Beside the best law alone, others have been tried."""
    one, pair = fit_of("slid", [1.0, 2.0]), fit_of("turned", [1.0, 1.0])
    pair = replace(pair, others=(one.family,))
    worse = replace(fit_of("age", [3.0, 3.0]), others=(one.family,))
    seen = []
    monkeypatch.setattr(together, "laws_beside", lambda _, pairs, first: seen.append(pairs) or [])
    assert together.beside_several(None, None, [one, worse, pair], [one], Workers()) == []
    assert seen == [[pair]]
