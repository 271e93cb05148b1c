"""Which free-form law closes most of a gap."""

from dataclasses import replace

import numpy as np
import pytest
from free_forms import CURVE, LEVEL, family_of, free_fit, linear_fit, one_trial, priors, solved

from diagnosis.criteria import CLOSED_GAP, FAR_GAP
from diagnosis.fitting.fit import Fit
from diagnosis.freeform import search
from diagnosis.freeform.fits.checked import predictive_gap
from diagnosis.freeform.fits.free_fit import FreeFit, with_family
from diagnosis.freeform.search import free_form_fits
from diagnosis.selection.screening import Screened
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed

TRIALS, SAMPLES = 3, 200


def log_of_a_law(rng, reach=1.0, last=0.0):
    """A fit of a law to all trials, and what each leaves when the others predict it.

    Args:
      reach: of coordinates of which the last trial alone tells, in units of the noise.
      last: by which they are others in the last trial.
    """
    family = family_of(name="law")
    truth = rng.normal(size=CURVE.size)
    slopes = [rng.normal(size=(SAMPLES, CURVE.size)) for _ in range(TRIALS)]
    for j in slopes[:-1]:
        j[:, 5:] = 0.0
    slopes[-1][:, 5:] *= reach
    moved = [*[np.zeros(CURVE.size)] * (TRIALS - 1), np.full(CURVE.size, last)]
    each = zip(slopes, moved, strict=True)
    readings = [j @ (truth + own) + rng.normal(size=SAMPLES) for j, own in each]
    fit = linear_fit(family, slopes, readings)
    held_out = []
    for i, (j, y) in enumerate(zip(slopes, readings, strict=True)):
        rest = [k for k in range(TRIALS) if k != i]
        others = solved([slopes[k] for k in rest], [readings[k] for k in rest], priors(family))
        held_out.append(j @ others - y)
    return fit, held_out


def rms(by_trial):
    return float(np.sqrt(np.mean(np.concatenate(by_trial) ** 2)))


def test_a_law_that_holds_has_a_predictive_gap_of_one_where_no_other_trial_has_been():
    """Mean of the squares is 1: the residual is a draw from what the prior leaves open, and noise."""
    rng = np.random.default_rng(1)
    logs = [log_of_a_law(rng, reach=5.0) for _ in range(40)]
    squares = np.array([predictive_gap(*log) ** 2 for log in logs])
    spread = squares.std() / np.sqrt(squares.size)
    assert np.mean(squares) == pytest.approx(1.0, abs=3.5 * spread)
    assert np.mean([rms(held_out) for _, held_out in logs]) > 3.0


def test_of_a_law_that_the_other_trials_determine_it_is_the_gap():
    fit, held_out = log_of_a_law(np.random.default_rng(2), reach=0.0)
    # 5 coordinates of 400 samples: what they leave open is 1 % of the noise.
    assert predictive_gap(fit, held_out) == pytest.approx(rms(held_out), rel=0.02)
    assert predictive_gap(fit, held_out) == pytest.approx(1.0, abs=0.1)


def test_a_law_that_is_another_in_the_last_trial_is_above_one():
    fit, held_out = log_of_a_law(np.random.default_rng(3), reach=0.0, last=3.0)
    assert predictive_gap(fit, held_out) > 1.5


def test_a_score_is_a_cost_in_its_own_units_and_a_penalty_for_what_data_determine():
    simple, free = (free_fit(1.0, freedom=n) for n in (1, 4))
    given = {"by_trial": (np.full(100, 1.0),), "jacobian": (np.zeros((100, 1)),), "cost": 100.0}
    one = replace(simple, fit=replace(simple.fit, **given))
    assert one.score == pytest.approx(np.log(100), abs=1e-6)  # a level without a prior counts whole
    loud = replace(one, fit=replace(one.fit, cost=200.0))
    assert loud.score - one.score == pytest.approx(100 * np.log(2))
    beside = replace(one, beside=("tip_drag",))
    assert beside.score - one.score == pytest.approx(2 * np.log(100))
    free_given = given | {"jacobian": (np.zeros((100, 4)),)}
    four = replace(free, fit=replace(free.fit, **free_given))
    assert four.score - one.score == pytest.approx(3 * np.log(100), abs=1e-6)


def test_a_family_is_fitted_as_an_effect_of_the_library():
    problem, _ = one_trial(np.linspace(0, 90, 200), tip=np.zeros(200))
    own, family = with_family(problem, family_of(name="mine")), family_of(name="mine")
    assert own.library["mine"].parameters == family.effect.parameters
    assert set(own.library) == {*problem.library, "mine"}
    assert "mine" not in problem.library


@pytest.fixture
def fitted(monkeypatch):
    """The search among families whose fits are given: gaps by name, first, to the end, on the log."""
    problem, nominal = one_trial(np.linspace(0, 90, 200), tip=np.zeros(200))
    seen = []

    def run(first, ended, final=None, effects=()):
        run.enough = []
        final = ended if final is None else final

        def made(gaps, family, beside=(), *enough, **known):
            seen.append((family.name, beside, known.get("final", False)))
            run.enough += enough[:1]
            gap = gaps[f"{family.name} + {beside[0]}" if beside else family.name]
            if gap is None:
                raise SimulationFailed("lost")
            fit = linear_fit(family, [np.zeros((100, 1))], [np.full(100, gap)], x=[0.0])
            return FreeFit(family=family, fit=fit, beside=beside, gap_after=gap, **known)

        given = {
            "families_of": lambda _: [family_of(parameters=[LEVEL], name=name) for name in first],
            "replay": lambda *_, **__: nominal,
            "fit_effects": lambda *_, **__: None,
            "_first_fit": lambda _, __, family: made(first, family),
            "_to_its_end": lambda _, one, beside, *enough: made(ended, one.family, beside, *enough),
            "_screened_beside": lambda _, law, name: Screened(
                names=(law.family.name, name),
                start=np.zeros(2),
                cost=100 * ended[f"{law.family.name} + {name}"] ** 2,
                gain=0.0,
            ),
            "_some_more": lambda _, one: one,
            "_on_the_log": lambda _, one, far: made(final, one.family, one.beside, final=True),
        }
        for name, function in given.items():
            monkeypatch.setattr(search, name, function)
        return free_form_fits(problem, problem, effects, Workers())

    return run, seen


def test_the_best_families_go_to_their_end_and_the_best_of_these_to_the_log_itself(fitted):
    run, seen = fitted
    gaps = {f"law {i}": 1.2 + 0.05 * i for i in range(12)}
    found = run(gaps, gaps)
    finals = [f.family.name for f in found if f.final]
    assert finals == [f"law {i}" for i in range(search.FINALISTS)]
    # Every family is there once, those of the log itself before the others.
    assert sorted(f.family.name for f in found) == sorted(gaps)
    assert all(f.final for f in found[: search.FINALISTS])
    assert len(seen) == 12 + search.CONTENDERS + search.FINALISTS


@pytest.mark.parametrize(
    ("least", "reach"),
    [(1.0, search.WORTH_A_FINAL_BESIDE), (2 * CLOSED_GAP, search.IN_REACH)],
    ids=["the gap is closed", "it is not"],
)
def test_only_laws_that_promise_no_more_than_a_few_times_the_least_gap_go_on(least, reach, fitted):
    run, seen = fitted
    gaps = {"a": least, "b": 0.95 * reach * least, "c": 1.05 * reach * least}
    found = run(gaps, gaps)
    assert [name for name, _, _ in seen[len(gaps) : len(gaps) + 2]] == ["a", "b"]
    assert "c" not in [name for name, _, _ in seen[len(gaps) :]]
    assert sorted(f.family.name for f in found) == sorted(gaps)  # each is told, however far it came


def test_beside_an_effect_a_law_has_to_come_near_the_best_alone(fitted):
    run, _ = fitted
    gaps = {"a": 2.0, "b": 2.5, "a + stiction": 2.1, "b + stiction": 2.6}
    run({"a": 2.0, "b": 2.5}, gaps, effects=("stiction",))
    assert run.enough == [pytest.approx(100 * (search.WORTH_A_FINAL * 2.0) ** 2)] * 2


def test_a_law_that_comes_nowhere_at_first_goes_on_where_its_slopes_promise_more(fitted, monkeypatch):
    """Of ten, three go on; the last is the only one whose next step would close the gap."""
    run, seen = fitted
    gaps = {f"law {i}": 2.0 + 0.1 * i for i in range(10)}
    promised = Fit.promised_cost.func
    last = max(gaps.values()) ** 2 * 100
    monkeypatch.setattr(
        Fit, "promised_cost", property(lambda fit: 100.0 if fit.cost >= last - 1e-6 else promised(fit))
    )
    monkeypatch.setattr(search, "CONTENDERS", 3)
    run(gaps, gaps)
    assert [name for name, _, _ in seen[10:13]] == ["law 9", "law 0", "law 1"]


def test_fewer_go_to_the_log_itself_where_all_leave_far_more_than_noise(fitted):
    run, _ = fitted
    gaps = {f"law {i}": FAR_GAP + 0.1 + 0.1 * i for i in range(12)}
    assert sum(f.final for f in run(gaps, gaps)) == search.FAR_FINALISTS < search.FINALISTS


@pytest.mark.parametrize(
    ("least", "reach"),
    [(1.0, search.WORTH_A_FINAL_BESIDE), (1.01 * CLOSED_GAP, search.WORTH_A_FINAL)],
)
def test_laws_far_behind_the_best_do_not_go_to_the_log_itself(least, reach, fitted):
    run, _ = fitted
    gaps = {"a": least, "b": 0.95 * reach * least, "c": 1.05 * reach * least}
    assert [f.family.name for f in run(gaps, gaps) if f.final] == ["a", "b"]


def test_where_one_law_closes_the_gap_no_effect_is_tried_beside_it(fitted):
    run, seen = fitted
    run({"a": 2.0, "b": 3.0}, {"a": 1.05, "b": 3.0}, effects=("tip_drag",))
    assert not any(beside for _, beside, _ in seen)


def test_where_none_does_the_nearest_effects_of_the_library_stand_beside_the_best(fitted):
    run, _ = fitted
    ended = {"a": 2.0, "b": 3.0, "a + tip_drag": 1.0, "b + tip_drag": 2.9}
    found = run({"a": 2.0, "b": 3.0}, ended, effects=("tip_drag",))
    assert [(f.family.name, f.beside) for f in found] == [("a", ("tip_drag",)), ("b", ())]


def test_beside_a_law_go_the_effects_that_promise_most_there(fitted):
    run, seen = fitted
    gaps = {"tip_drag": 1.9, "stiction": 1.2, "torque_bias": 1.05}
    run({"a": 2.0}, {"a": 2.0} | {f"a + {name}": gap for name, gap in gaps.items()}, effects=(*gaps,))
    tried = [beside for _, beside, final in seen if beside and not final]
    assert tried == [("torque_bias",), ("stiction",)]


def test_what_cannot_be_simulated_is_left_out(fitted):
    run, _ = fitted
    assert [f.family.name for f in run({"a": None, "b": 2.0}, {"b": 1.05})] == ["b"]
    assert run({"a": None}, {}) == ()
