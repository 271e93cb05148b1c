"""Which free-form law closes most of a gap."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from free_forms import LEVEL, family_of, linear_fit, one_trial

from diagnosis.criteria.freeform import CLOSED_GAP, FAR_GAP, THIRD_LAW_GAP
from diagnosis.fitting.fit import Fit
from diagnosis.freeform import search
from diagnosis.freeform.fits import combined_laws
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.search import fits_in_noise, free_form_fits
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.screening import Screened
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed


def fit_of(family, gap):
    """A fit that leaves a gap and promises no other."""
    return linear_fit(family, [np.zeros((100, 1))], [np.full(100, gap)], x=[0.0])


@pytest.fixture
def fitted(monkeypatch):
    """The search among families whose fits are given: gaps by name, first, to the end, on the log."""
    problem, nominal = one_trial(np.linspace(0, 90, 200), tip=np.zeros(200))
    seen = []

    def run(first, ended, final=None, effects=(), known=()):
        run.enough = []
        final = ended if final is None else final

        def made(gaps, one, *enough, **known):
            seen.append((one.family.name, one.names[1:], known.get("final", False)))
            run.enough += enough[:1]
            gap = gaps[" + ".join(one.names)]
            if gap is None:
                raise SimulationFailed("lost")
            return replace(one, fit=fit_of(one.family, gap), gap_after=gap, **known)

        def iterated(one, iterations):
            run.more.append((one.family.name, iterations))
            gap = run.improved.get(one.family.name)
            return one if gap is None else replace(one, fit=fit_of(one.family, gap))

        def pairs_of_laws(_, laws, others):
            pairs = (replace(law, others=(*law.others, o.family)) for law in laws for o in others)
            return [pair for pair in pairs if " + ".join(pair.names) in ended]

        given = {
            "families_of": lambda _: [family_of(parameters=[LEVEL], name=name) for name in first],
            "replay": lambda *_, **__: nominal,
            "fit_effects": lambda *_, **__: None,
            "on_coarser_needle": lambda coarse, _: coarse,
            "first_fit": lambda _, __, family: made(first, FreeFit(family=family, fit=None)),
            "full_fit": lambda _, one, *enough: made(ended, one, *enough),
            "richer": lambda _, laws, *__, growing: [
                made(ended, replace(law, family=family_of(parameters=[LEVEL], name=name)))
                for law in laws
                for name in ended
                if name.startswith(f"{law.family.name}, {'growing' if growing else 'finer'}")
            ],
            "begun_only": lambda _, one, *enough: made(ended, one, *enough),
            "pairs_beside": lambda _, __, ___, laws, names, ____: [
                (law, Screened(names=(law.family.name, name), start=np.zeros(2), cost=0.0, gain=0.0))
                for law in laws
                for name in names
            ],
            "laws_beside": pairs_of_laws,
            "_some_more": lambda _, one, iterations: iterated(one, iterations),
            "_on_the_log": lambda _, one, far: made(final, one, final=True),
        }
        for name, function in given.items():
            for module in (search, combined_laws):
                monkeypatch.setattr(module, name, function, raising=False)
        fits = [FreeFit(family=family_of(parameters=[LEVEL], name=n), fit=None) for n in known]
        fits = [replace(one, fit=fit_of(one.family, known[one.family.name])) for one in fits]
        return free_form_fits(problem, problem, effects, Workers(), fits)

    run.more, run.improved = [], {}
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


def test_families_that_are_known_go_on_from_their_fits(fitted):
    run, seen = fitted
    gaps = {"a": 2.0, "b": 2.1, "c": 2.2}
    found = run(gaps, {**gaps, "b": 1.05}, known={"b": 1.5, "richer": 5.0})
    begun, ended = seen[:2], seen[2:5]
    assert [name for name, _, _ in begun] == ["a", "c"]
    assert [name for name, _, _ in ended] == ["b", "a", "c"]
    assert sorted(f.family.name for f in found) == ["a", "b", "c", "richer"]


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


def test_beside_an_effect_a_law_has_to_leave_less_than_the_best_alone(fitted):
    run, _ = fitted
    gaps = {"a": 2.0, "b": 2.5, "a + stiction": 2.1, "b + stiction": 2.6}
    run({"a": 2.0, "b": 2.5}, gaps, effects=("stiction",))
    assert (
        run.enough == [pytest.approx(100 * 2.0**2)] * 6
    )  # begun and ended for a rougher needle, and after it


def test_a_law_that_comes_nowhere_at_first_goes_on_where_its_slopes_promise_more(fitted, monkeypatch):
    """Of ten, three go on; the last is the only one whose next step would close the gap."""
    run, seen = fitted
    gaps = {f"law {i}": 2.0 + 0.1 * i for i in range(10)}
    promised = Fit.predicted_cost.func
    last = max(gaps.values()) ** 2 * 100
    monkeypatch.setattr(
        Fit, "predicted_cost", property(lambda fit: 100.0 if fit.cost >= last - 1e-6 else promised(fit))
    )
    monkeypatch.setattr(search, "CONTENDERS", 3)
    run(gaps, gaps)
    assert [name for name, _, _ in seen[10:13]] == ["law 9", "law 0", "law 1"]


def test_a_law_that_comes_far_with_its_second_iteration_gets_more(fitted):
    """It is far from straight, and shows little with its first."""
    run, seen = fitted
    gaps = {f"law {i:02}": 2.0 + 0.02 * i for i in range(search.WORTH_A_SECOND + 2)}
    first, (late, *others) = list(gaps)[: search.WORTH_MORE], list(gaps)[search.WORTH_A_SECOND - 1 :]
    run.improved = {late: 1.5}
    run(gaps, {**gaps, late: 1.5})
    assert {name for name, iterations in run.more if iterations == 1}.isdisjoint(others)
    assert [name for name, iterations in run.more if iterations > 1] == [late, *first[:-1]]
    assert seen[len(gaps)][0] == late


@pytest.mark.parametrize(("gap", "in_reach"), [(0.95, True), (1.05, False)])
def test_after_one_iteration_laws_are_in_reach_that_would_not_be_later(fitted, gap, in_reach):
    run, seen = fitted
    far = gap * search.IN_REACH_AT_FIRST * 1.2
    run.improved = {"far": 1.3}
    run({"near": 1.2, "far": far}, {"near": 1.2, "far": 1.0})
    assert (("far", 1) in run.more) is in_reach
    assert ("far" in [name for name, _, _ in seen[2:]]) is in_reach


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


def test_where_no_law_closes_the_gap_two_are_fitted_and_only_where_these_do_not_three(fitted):
    run, seen = fitted
    alone = {"a": 2.0, "b": 2.1, "c": 2.2}
    found = run(alone, {**alone, "a + b": 1.05, "a + b + c": 1.0})
    assert found[0].names == ("a", "b")
    assert ("a", ("b", "c"), False) not in seen
    found = run(alone, {**alone, "a + b": THIRD_LAW_GAP - 0.1, "a + b + c": 1.0})
    assert found[0].names == ("a", "b", "c")
    run(alone, {**alone, "a": 1.0, "a + b": 0.9})
    assert seen[-1][1] == ()  # one closes the gap


def test_no_third_law_is_tried_where_two_leave_far_more_than_noise(fitted):
    run, seen = fitted
    alone, far = {"a": 3.0, "b": 3.1, "c": 3.2}, THIRD_LAW_GAP + 0.1
    found = run(alone, {**alone, "a + b": far, "a + b + c": 1.0})
    assert found[0].names == ("a", "b")
    assert ("a", ("b", "c"), False) not in seen


def test_a_law_that_grows_is_tried_before_two_laws_are(fitted):
    run, seen = fitted
    alone, grown = {"a": 2.0, "b": 2.1}, "a, growing with time"
    found = run(alone, {**alone, grown: 1.05, "a + b": 1.0})
    assert found[0].names == (grown,)
    assert ("a", ("b",), False) not in seen
    found = run(alone, {**alone, grown: 1.5, "a + b": 1.0})
    assert found[0].names == ("a", "b")


def test_a_finer_curve_takes_the_place_of_the_usual_one_where_it_leaves_less(fitted):
    """Also where the gap is closed; a law that grows is tried only where it is not."""
    run, seen = fitted
    gaps = {"a": 1.05, "b": 1.06, "a, finer": 0.9, "a, growing with time": 0.8}
    found = run({"a": 1.05, "b": 1.06}, gaps)
    assert [f.family.name for f in found if f.final] == ["a, finer", "a", "b"]
    assert not any("growing" in name for name, _, _ in seen)
    run({"a": 1.0, "b": 1.5}, {"a": 1.0, "b": 1.5, "b, finer": 0.9})
    assert not any(name == "b, finer" for name, _, _ in seen)  # its law is far behind the best


def test_of_a_law_and_its_finer_curve_which_have_one_name_the_better_goes_on(monkeypatch):
    family = family_of(parameters=[LEVEL], name="a")
    worse, better = (
        FreeFit(
            family=family, fit=linear_fit(family, [np.zeros((100, 1))], [np.full(100, gap)], x=[0.0])
        )
        for gap in (1.0, 0.9)
    )
    for usual, finer in ((worse, better), (better, worse)):
        monkeypatch.setattr(search, "richer", lambda *_, finer=finer, **__: [finer])
        assert search._richer(None, [], [usual], SimpleNamespace(in_more_detail=None), None) == [better]


@pytest.mark.parametrize(("gap", "detail"), [(0.9, ["usual", "more"]), (1.1, ["usual"])])
def test_where_a_finer_curve_leads_one_that_is_finer_still_is_tried(monkeypatch, gap, detail):
    family = family_of(parameters=[LEVEL], name="a")
    usual, finer = (
        FreeFit(
            family=family, fit=linear_fit(family, [np.zeros((100, 1))], [np.full(100, own)], x=[0.0])
        )
        for own in (1.0, gap)
    )
    asked = []
    monkeypatch.setattr(search, "richer", lambda _, __, own, *___, **____: asked.append(own) or [finer])
    more = SimpleNamespace(name="more")
    ranges = SimpleNamespace(name="usual", in_more_detail=more)
    search._richer(None, [], [usual], ranges, None)
    assert [own.name for own in asked] == detail


def test_of_one_leading_law_no_more_than_a_few_go_to_the_log_itself(fitted):
    run, _ = fitted
    alone = {f"law {i}": 1.5 for i in range(5)}
    pairs = {f"law 0 + law {i}": 1.2 + 0.01 * i for i in range(1, 5)}
    finals = [f.names for f in run(alone, {**alone, **pairs}) if f.final]
    of_first = [names for names in finals if names[0] == "law 0"]
    assert of_first == [("law 0", "law 1"), ("law 0", "law 2")]
    assert len(of_first) == search.FINALISTS_OF_ONE < len(pairs)


def test_what_cannot_be_simulated_is_left_out(fitted):
    run, _ = fitted
    assert [f.family.name for f in run({"a": None, "b": 2.0}, {"b": 1.05})] == ["b"]
    assert run({"a": None}, {}) == ()


@pytest.mark.parametrize(
    ("numbers", "go_on"), [(10, search.FINALISTS), (30, 3), (60, search.FEWEST_FINALISTS)]
)
def test_fewer_of_laws_with_many_numbers_go_to_the_log_itself(numbers, go_on):
    """Each number is a simulation: 90 in all, and two laws in any case."""
    family = family_of(parameters=[replace(LEVEL, name=f"{i}") for i in range(numbers)])
    fit = linear_fit(family, [np.zeros((100, numbers))], [np.zeros(100)], x=np.zeros(numbers))
    ranked = [FreeFit(family=family, fit=fit)] * 6
    assert search._affordable(ranked) == go_on


def test_where_the_only_laws_in_reach_cannot_be_simulated_the_next_ones_are_fitted(fitted):
    run, _ = fitted
    first = {"lost": 1.2, "near": 1.2 * search.IN_REACH + 0.5, "far": 1.2 * search.IN_REACH + 1.0}
    found = run(first, {"lost": None, "near": 2.0, "far": 3.0})
    assert next(f.family.name for f in found if f.final) == "near"


@pytest.fixture
def in_half_the_noise(monkeypatch):
    """Fits of a log in half the noise, in which the law comes to a gap; and what was begun anew."""
    problem, _ = one_trial(np.linspace(0, 90, 200), tip=np.zeros(200))
    noise = problem.noise
    half = replace(problem, noise=replace(noise, sigma={s: 0.5 * v for s, v in noise.sigma.items()}))
    fits = tuple(leaving(problem, name, 1.0, final=name == "best") for name in ("best", "behind"))

    def run(gap):
        anew = []

        def fitted_anew(coarse, one, enough, start):
            assert coarse is half
            # what stays above this is no finalist beside a law that closes the gap
            assert enough == pytest.approx((search.WORTH_A_FINAL * CLOSED_GAP) ** 2 * half.samples)
            np.testing.assert_array_equal(start, one.fit.x)
            return leaving(half, one.family.name, gap, final=False)

        def all_anew(*given):
            anew.append(given)
            return ()

        monkeypatch.setattr(search, "full_fit", fitted_anew)
        monkeypatch.setattr(search, "_on_the_log", lambda _, one, far: replace(one, final=True))
        monkeypatch.setattr(search, "free_form_fits", all_anew)
        before, after = (problem, problem), (half, half)
        return fits_in_noise(before, after, fits, ("stiction",), Workers()), anew

    return run


def leaving(problem, name, gap, *, final):
    """The fit of a family that leaves so many sigma of every reading."""
    family = family_of(parameters=[LEVEL], name=name)
    rows = problem.residuals([NOMINAL])[0][0].size
    fit = linear_fit(family, [np.zeros((rows, 1))], [np.full(rows, gap)], x=[0.0])
    return FreeFit(family=family, fit=fit, gap_after=gap, final=final)


def test_laws_that_close_the_gap_in_less_noise_go_on_from_where_they_are(in_half_the_noise):
    fits, anew = in_half_the_noise(CLOSED_GAP - 0.05)
    assert anew == []
    assert [(f.family.name, f.final, f.gap_after) for f in fits] == [
        ("best", True, pytest.approx(CLOSED_GAP - 0.05)),
        ("behind", False, pytest.approx(2.0)),  # as many readings, in half the noise
    ]


def test_where_none_does_the_search_is_made_again_from_what_each_family_leaves_there(in_half_the_noise):
    fits, [(problem, coarse, effects, _, known)] = in_half_the_noise(CLOSED_GAP + 0.05)
    assert fits == ()
    assert problem is coarse
    assert effects == ("stiction",)
    assert [(f.family.name, f.fit.gap) for f in known] == [
        ("best", pytest.approx(CLOSED_GAP + 0.05)),
        ("behind", pytest.approx(2.0)),
    ]
