"""Which sets that screening promises something of are fitted, and why others are not."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import FITTED_SAMPLES, NO_LOG

from diagnosis.criteria.selection import CONTENDING, NEAR_FLOOR, PREDICTION_MISSED
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.fit_status import Termination
from diagnosis.selection import fitting, screened_fits
from diagnosis.selection.record import Decision
from diagnosis.selection.screened_fits import fit_screened
from diagnosis.selection.screening import Screened
from diagnosis.workers import Workers

FOUR = ("tip_drag", "torque_bias", "tip_angle_bias", "coulomb_friction")


def screened(name, promise, fitted=None):
    """An effect that promises a cost, and what its fit comes to."""
    start = np.array([promise if fitted is None else fitted])
    return Screened(names=(name,), start=start, cost=promise, gain=10.0)


def decisions(record):
    return {(e.effects, e.decision): e for e in record}


def test_the_most_promising_are_fitted_first_and_come_back_best_first(made):
    each = [screened("tip_drag", 3000.0, 2000.0), screened("torque_bias", 2500.0, 2900.0)]
    found, record = fit_screened("single", NO_LOG, each, 9, Workers())
    assert made == [("torque_bias",), ("tip_drag",)]
    assert [c.names for c in found] == [("tip_drag",), ("torque_bias",)]
    assert {e.decision for e in record} == {Decision.MADE}


def test_no_more_are_fitted_than_asked_for(made):
    each = [screened("tip_drag", 3000.0), screened("torque_bias", 2500.0)]
    fit_screened("single", NO_LOG, each, 1, Workers())
    assert made == [("torque_bias",)]


BATCH = [
    screened(n, 900.0 + i, 1000.0)
    for i, n in enumerate(("stiction", "tip_drag", "torque_bias", "tip_angle_bias"))
]


def test_once_something_is_at_the_floor_only_what_comes_near_or_is_contained_is_fitted(made):
    far = NEAR_FLOOR * FITTED_SAMPLES + 100
    later = [
        screened("entry_friction", far),
        screened("coulomb_friction", far),
        screened("tip_angle_scale", 0.9 * far),
    ]
    _, record = fit_screened("single", NO_LOG, [*BATCH, *later], 9, Workers())
    assert ("entry_friction",) not in made
    assert {("coulomb_friction",), ("tip_angle_scale",)} <= set(made)  # stiction contains the one
    out = decisions(record)[("entry_friction",), Decision.DROPPED]
    assert "far above" in out.reason
    assert out.score is None


def test_a_fit_has_to_come_near_the_best_once_that_is_at_the_floor(made):
    """Of what comes later: the cost of the best, and what may be contended."""
    at_floor = [screened(name, 1.0 + i, 0.9 * FITTED_SAMPLES) for i, name in enumerate(FOUR)]
    later = [screened("entry_friction", 9.0, 2 * FITTED_SAMPLES)]
    fit_screened("single", NO_LOG, [*at_floor, *later], 9, Workers(), used=6)
    assert made.allowed[:4] == [np.inf] * 4
    # Both have one parameter and are singles, so that their penalties are the same.
    assert made.allowed[4] == pytest.approx(0.9 * FITTED_SAMPLES + CONTENDING)


def test_as_many_as_are_of_use_are_fitted_to_their_end(made):
    above = [screened(name, 1.0 + i, (4.0 + i) * FITTED_SAMPLES) for i, name in enumerate(FOUR)]
    later = [screened("entry_friction", 9.0, 9 * FITTED_SAMPLES)]
    for used, allowed in (
        (6, np.inf),
        (2, max(4.0 * FITTED_SAMPLES + CONTENDING, 5.0 * FITTED_SAMPLES)),
    ):
        made.allowed.clear()
        fit_screened("single", NO_LOG, [*above, *later], 9, Workers(), used=used)
        assert made.allowed[4] == pytest.approx(allowed)


def test_the_best_start_of_a_set_is_kept(made):
    each = [screened("tip_drag", 2000.0, 2500.0), screened("tip_drag", 2100.0, 2200.0)]
    (found,), record = fit_screened("single", NO_LOG, each, 9, Workers())
    assert found.fit.cost == 2200.0
    (out,) = [e for e in record if e.decision is Decision.DROPPED]
    assert "another start" in out.reason


def start_of(names, promise, fitted):
    return replace(screened("tip_drag", promise, fitted), names=names)


def test_the_first_start_of_each_set_is_fitted_before_the_second_of_any(made):
    two, reversed_ = ("tip_drag", "stiction"), ("stiction", "tip_drag")
    each = [
        start_of(two, 3000.0, 3000.0),
        start_of(reversed_, 3100.0, 2900.0),
        start_of(("torque_bias",), 3200.0, 3200.0),
    ]
    found, _ = fit_screened("pairs", NO_LOG, each, 9, Workers())
    assert made == [two, ("torque_bias",), reversed_]
    assert [c.names for c in found] == [reversed_, ("torque_bias",)]


@pytest.mark.parametrize(("promise", "fitted"), [(1.01, False), (0.99, True)])
@pytest.mark.parametrize("left", [1.0, 2.0], ids=["at the floor", "above it"])
def test_another_start_of_a_set_has_to_promise_less(left, promise, fitted, made, monkeypatch):
    """At the floor; above it, of a set that another one leaves behind."""
    monkeypatch.setattr(screened_fits, "FITS_AT_ONCE", 1)
    less = 0.8 * left * FITTED_SAMPLES
    ahead = [start_of(("tip_drag",), less, less)] if left > 1.0 else []
    first = start_of(("stiction",), 0.9 * left * FITTED_SAMPLES, left * FITTED_SAMPLES)
    again = start_of(("stiction",), promise * left * FITTED_SAMPLES, left * FITTED_SAMPLES)
    _, record = fit_screened("single effects", NO_LOG, [*ahead, first, again], 9, Workers())
    assert len(made) == len(ahead) + 1 + fitted
    (out,) = [entry.reason for entry in record if entry.decision is Decision.DROPPED]
    assert out.endswith("fits better" if fitted else "no more than this one promises")


def one_by_one(monkeypatch, **ending):
    """Fits are made one after the other, and end as stated."""
    inner = fitting.fit_in_turn

    def fit_in_turn(*arguments, **keywords):
        fit = inner(*arguments, **keywords)
        return replace(fit, status=replace(fit.status, **ending))

    monkeypatch.setattr(fitting, "fit_in_turn", fit_in_turn)
    monkeypatch.setattr(screened_fits, "FITS_AT_ONCE", 1)


@pytest.mark.parametrize(
    ("left", "termination", "fitted"),
    [
        (2.0, Termination.FAR, True),
        (2.0, Termination.STEP, True),
        (1.0, Termination.FAR, False),
        (1.0, Termination.STEP, False),
        (0.8, Termination.STEP, True),
    ],
)
def test_other_starts_of_what_leaves_least_are_fitted_unless_it_leaves_noise_no_more_and_no_less(
    left, termination, fitted, made, monkeypatch
):
    """Less is left than noise where that was taken to be more than it is."""
    one_by_one(monkeypatch, termination=termination)
    first = start_of(("stiction",), 0.9 * left * FITTED_SAMPLES, left * FITTED_SAMPLES)
    again = start_of(("stiction",), 1.1 * left * FITTED_SAMPLES, left * FITTED_SAMPLES)
    fit_screened("single effects", NO_LOG, [first, again], 9, Workers())
    assert len(made) == 1 + fitted


@pytest.mark.parametrize("at_bound", [(), ("stiction.static",)])
def test_other_starts_of_what_came_to_the_floor_at_a_bound_are_fitted(at_bound, made, monkeypatch):
    one_by_one(monkeypatch, at_bound=at_bound)
    first = start_of(("stiction",), 0.9 * FITTED_SAMPLES, FITTED_SAMPLES)
    again = start_of(("stiction",), 2 * NEAR_FLOOR * FITTED_SAMPLES, 0.9 * FITTED_SAMPLES)
    fit_screened("single effects", NO_LOG, [first, again], 9, Workers())
    assert len(made) == 1 + bool(at_bound)


def test_what_leaves_far_more_than_promised_is_fitted_once_more_from_a_neutral_start(made, monkeypatch):
    """Of the two starts of a set, once; and where the promise is kept, not at all."""
    monkeypatch.setattr(
        screened_fits, "neutral_start", lambda _, one: np.array([0.5 * PREDICTION_MISSED * one.cost])
    )
    broken = start_of(("stiction",), 2000.0, 1.01 * PREDICTION_MISSED * 2000.0)
    twice = start_of(("stiction",), 2100.0, 1.01 * PREDICTION_MISSED * 2100.0)
    kept = start_of(("tip_drag",), 2000.0, 0.99 * PREDICTION_MISSED * 2000.0)
    found, _ = fit_screened("single effects", NO_LOG, [broken, twice, kept], 9, Workers())
    assert made == [("stiction",), ("tip_drag",), ("stiction",), ("stiction",)]
    assert {c.names: c.fit.cost for c in found} == pytest.approx(
        {
            ("stiction",): 0.5 * PREDICTION_MISSED * 2000.0,
            ("tip_drag",): 0.99 * PREDICTION_MISSED * 2000.0,
        }
    )


@pytest.mark.parametrize("wound", [True, False])
def test_a_fit_that_wound_up_a_past_as_far_as_it_goes_begins_once_more(wound, made, monkeypatch):
    monkeypatch.setattr(Fit, "trial_at_bound", property(lambda fit: wound and fit.cost > 2000.0))
    monkeypatch.setattr(screened_fits, "neutral_start", lambda *_: np.array([1900.0]))
    kept = start_of(("stiction",), 2000.0, 2100.0)
    (found,), _ = fit_screened("single effects", NO_LOG, [kept], 9, Workers())
    assert len(made) == (2 if wound else 1)
    assert found.fit.cost == pytest.approx(1900.0 if wound else 2100.0)


def test_a_fit_that_fails_is_recorded_and_the_others_go_on(made):
    each = [screened("tip_drag", 2000.0, np.nan), screened("torque_bias", 2100.0)]
    (found,), record = fit_screened("single", NO_LOG, each, 9, Workers())
    assert found.names == ("torque_bias",)
    assert decisions(record)[("tip_drag",), Decision.FAILED].reason == "lost its numbers"
