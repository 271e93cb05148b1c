"""Laws that leave the same count once."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from free_forms import family_of, linear_fit

from diagnosis.effects.effect import Place
from diagnosis.freeform.fits import combined_laws
from diagnosis.freeform.fits.combined_laws import distinct, unlike
from diagnosis.freeform.fits.free_fit import FreeFit
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


def test_of_laws_that_leave_the_same_the_one_whose_place_is_surest_stands_for_both():
    """An offset of the drive in each trial, say, and one of what the tip sensor reads."""
    drive, sensor = (fit_of(name, [1.0, 2.0]) for name in ("drive", "reading"))
    either = {Place.DRIVE: 0.5, Place.SENSOR: 0.5}
    drive = replace(drive, family=replace(drive.family, places=either))
    sensor = replace(sensor, family=replace(sensor.family, places={Place.SENSOR: 1.0}))
    for ranked in ([drive, sensor], [sensor, drive]):
        (kept,) = unlike(ranked)
        assert kept.family.name == "reading"
        assert kept.family.places == pytest.approx({Place.DRIVE: 0.25, Place.SENSOR: 0.75})


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
    monkeypatch.setattr(combined_laws, "laws_beside", lambda _, pairs, first: seen.append(pairs) or [])
    assert combined_laws.beside_several(None, None, None, [one, worse, pair], [one], Workers()) == []
    assert seen == [[pair]]


@pytest.fixture
def fits_of(monkeypatch):
    """Fits that leave what is given by the name of their last law, and how they were asked for."""

    def given(lefts):
        seen = []

        def fitted(how, problem, one, enough, *_):
            seen.append((how, problem, one.names[-1], enough))
            left = np.array(lefts[one.names[-1]])
            flat = (np.zeros((left.size, one.fit.x.size)),)
            fit = replace(one.fit, by_trial=(left,), jacobian=flat, cost=float(left @ left))
            return replace(one, fit=fit, gap_after=fit.gap)

        for how in ("begun_only", "full_fit"):
            monkeypatch.setattr(combined_laws, how, partial(fitted, how))
        return seen

    return given


def with_last(law, lefts):
    """A law beside each of others, the worst first."""
    return [replace(law, others=(*law.others, family_of(name=name))) for name in reversed(lefts)]


def test_the_most_promising_pairs_go_on_for_a_rougher_needle_and_the_best_of_them_beyond(
    fits_of, monkeypatch
):
    """Each as any other fit: it has to leave less than the best so far."""
    law = fit_of("slid", [1.0, 2.0])
    lefts = {f"second {i}": [0.5 + 0.1 * i, 0.5] for i in range(combined_laws.WORTH_AN_END + 2)}
    seen, names = fits_of(lefts), list(lefts)
    monkeypatch.setattr(combined_laws, "laws_beside", lambda *_: with_last(law, lefts))
    monkeypatch.setattr(combined_laws, "pairs_beside", lambda *_: [])
    found = combined_laws.beside_one("coarse", "rough", None, [law], [law], (), Workers())
    assert [f.names[-1] for f in found] == names[: combined_laws.WORTH_MORE]
    assert [own[:3] for own in seen] == [
        *(("begun_only", "rough", name) for name in reversed(names)),
        *(("full_fit", "rough", name) for name in names[: combined_laws.WORTH_AN_END]),
        *(("full_fit", "coarse", name) for name in names[: combined_laws.WORTH_MORE]),
    ]
    assert {own[3] for own in seen} == {law.fit.cost}


def test_of_three_laws_the_most_promising_are_fitted_to_the_decimated_log_at_once(fits_of, monkeypatch):
    pair = replace(fit_of("slid", [1.0, 2.0]), others=(family_of(name="turned"),))
    lefts = {f"third {i}": [0.5 + 0.1 * i, 0.5] for i in range(combined_laws.THREE_WORTH_MORE + 2)}
    seen, names = fits_of(lefts), list(lefts)
    monkeypatch.setattr(combined_laws, "laws_beside", lambda *_: with_last(pair, lefts))
    found = combined_laws.beside_several("coarse", "rough", None, [pair], [pair], Workers())
    assert [f.names[-1] for f in found] == names[: combined_laws.THREE_WORTH_MORE]
    assert [own[:3] for own in seen] == [
        *(("begun_only", "rough", name) for name in reversed(names)),
        *(("full_fit", "coarse", name) for name in names[: combined_laws.THREE_WORTH_MORE]),
    ]
    assert {own[3] for own in seen} == {pair.fit.cost}
