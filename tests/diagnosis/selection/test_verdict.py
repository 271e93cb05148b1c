"""What is concluded from candidates whose scores are given."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import fit_of, scored

from diagnosis.criteria import PART_LEAD, SCATTER
from diagnosis.effects import LIBRARY
from diagnosis.fitting.noise_floor import NoiseFloor
from diagnosis.selection.candidate import candidate
from diagnosis.selection.verdict import (
    VerdictKind,
    distinct,
    places,
    provisional,
    refuted,
    verdict_on,
    with_open_effects,
)


def verdict(*each):
    """On candidates at the noise floor, by names and score."""
    return verdict_on(sorted((scored(*one) for one in each), key=lambda c: c.score))


@pytest.mark.parametrize(
    ("lead", "kind", "effects"),
    [
        (8, VerdictKind.EXPLAINED, ("stiction",)),
        (3, VerdictKind.UNDECIDED, ("coulomb_friction",)),
        (-3, VerdictKind.UNDECIDED, ("coulomb_friction",)),
        (-8, VerdictKind.EXPLAINED, ("coulomb_friction",)),
    ],
)
def test_an_effect_and_one_that_contains_it_are_told_apart_by_their_scores(lead, kind, effects):
    found = verdict((["coulomb_friction"], 100.0), (["stiction"], 100.0 - lead))
    assert (found.kind, found.effects) == (kind, effects)
    if kind is VerdictKind.UNDECIDED:
        assert set(found.confusable) == {("coulomb_friction",), ("stiction",)}


@pytest.mark.parametrize(("lead", "beside"), [(8, True), (12, False)])
def test_a_richer_form_that_nothing_asks_for_but_fits_is_named_beside(lead, beside):
    found = verdict((["coulomb_friction"], 100.0), (["stiction"], 100.0 + lead))
    assert (("stiction",) in found.confusable) is beside


def test_of_unrelated_effects_the_one_with_more_parameters_may_be_the_best():
    """What they cost is in the score."""
    found = verdict((["base_compliance"], 103.0), (["layered_tissue"], 100.0))
    assert (found.kind, found.effects) == (VerdictKind.UNDECIDED, ("layered_tissue",))


def test_a_ranking_is_of_what_explains_the_log():
    above = scored(["tip_drag"], 90.0, floor=NoiseFloor(gap=2.0, slow=5.0))
    found = verdict_on([above, scored(["entry_friction"], 100.0), scored(["stiction"], 104.0)])
    ranking = dict(found.ranking)
    assert ranking["tip_drag",] == 0.0
    assert ranking["entry_friction",] == pytest.approx(1 / (1 + np.exp(-2)))


@pytest.mark.parametrize(("lead", "kind"), [(8, VerdictKind.UNDECIDED), (12, VerdictKind.EXPLAINED)])
def test_unrelated_effects_are_told_apart_by_more(lead, kind):
    found = verdict((["tip_drag"], 100.0), (["entry_friction"], 100.0 + lead))
    assert found.kind is kind
    assert found.effects == ("tip_drag",)


def test_a_second_effect_has_to_lead_the_first_alone():
    near = verdict((["tip_drag"], 108.0), (["tip_drag", "torque_bias"], 100.0))
    assert (near.kind, near.effects) == (VerdictKind.EXPLAINED, ("tip_drag",))
    far = verdict((["tip_drag"], 112.0), (["tip_drag", "torque_bias"], 100.0))
    assert set(far.effects) == {"tip_drag", "torque_bias"}


def test_a_richer_form_with_a_second_effect_needs_the_wider_margin():
    near = verdict((["coulomb_friction"], 108.0), (["stiction", "torque_bias"], 100.0))
    assert (near.kind, near.effects) == (VerdictKind.EXPLAINED, ("coulomb_friction",))
    far = verdict((["coulomb_friction"], 112.0), (["stiction", "torque_bias"], 100.0))
    assert set(far.effects) == {"stiction", "torque_bias"}


def held(names, score):
    """A candidate of which one parameter stopped at a bound."""
    one = scored(names, score)
    (effect,) = names
    bound = f"{effect}.{LIBRARY[effect].reported[0].name}"
    return replace(one, fit=replace(one.fit, status=replace(one.fit.status, at_bound=(bound,))))


@pytest.mark.parametrize(("lead", "kind"), [(1, VerdictKind.UNDECIDED), (-1, VerdictKind.EXPLAINED)])
def test_what_is_held_by_a_bound_explains_nothing_but_leaves_open_what_it_leads(lead, kind):
    """A spring in series near its stiffest, so weak that stiffness of the shaft does nearly as well."""
    other = held(["base_compliance"], 100.0 - lead)
    found = verdict_on(sorted((scored(["stiffness_error"], 100.0), other), key=lambda c: c.score))
    assert (found.kind, found.effects) == (kind, ("stiffness_error",))
    assert (("base_compliance",) in found.confusable) is (kind is VerdictKind.UNDECIDED)


@pytest.mark.parametrize(("lead", "kind"), [(20, VerdictKind.EXPLAINED), (40, VerdictKind.UNDECIDED)])
def test_what_is_held_by_a_bound_beside_the_best_leaves_it_open_if_it_leads_clearly(lead, kind):
    """Freedom at a bound takes up a little of everything; 40 of a score is more than that."""
    both = scored(["stiffness_error", "layered_tissue"], 100.0 - lead)
    bound = replace(both.fit.status, at_bound=("layered_tissue.ratio",))
    both = replace(both, fit=replace(both.fit, status=bound))
    found = verdict_on([both, scored(["stiffness_error"], 100.0)])
    assert (found.kind, found.effects) == (kind, ("stiffness_error",))


def test_sets_that_cannot_be_told_apart_are_named_once_each():
    sets = [("tip_drag", "stiction"), ("stiction", "tip_drag"), (), ("tip_drag",), ()]
    assert distinct(sets) == (("tip_drag", "stiction"), (), ("tip_drag",))


def test_what_is_as_good_as_none_explains_nothing_but_leaves_open_what_it_leads():
    """Shear thinning of an exponent of 0.995, which dry friction replaces less well."""
    x = [0.995, 0.0]
    weak = replace(scored(["shear_thinning"], 60.0), fit=fit_of(("shear_thinning",), x=x))
    assert weak.as_good_as_none
    found = verdict_on([weak, scored(["coulomb_friction"], 100.0)])
    assert (found.kind, found.effects) == (VerdictKind.UNDECIDED, ("coulomb_friction",))
    assert ("shear_thinning",) in found.confusable
    beside = replace(
        scored(["tip_drag", "shear_thinning"], 60.0),
        fit=fit_of(("tip_drag", "shear_thinning"), x=[-3.0, *x]),
    )
    alone = verdict_on([beside, scored(["tip_drag"], 100.0)])
    assert (alone.kind, alone.effects) == (VerdictKind.EXPLAINED, ("tip_drag",))


def test_what_is_held_by_a_bound_and_above_the_noise_leaves_nothing_open():
    above = NoiseFloor(gap=2.0, slow=5.0)
    far = replace(held(["base_compliance"], 1.0), floor=above)
    assert verdict_on([far, scored(["stiffness_error"], 100.0)]).kind is VerdictKind.EXPLAINED
    assert verdict_on([held(["base_compliance"], 1.0)]).kind is VerdictKind.UNKNOWN


@pytest.mark.parametrize(
    ("lead", "kind"),
    [
        (7, VerdictKind.UNDECIDED),
        (-1, VerdictKind.UNDECIDED),
        (-1.1 * PART_LEAD, VerdictKind.EXPLAINED),
    ],
)
def test_what_only_brings_a_likelier_part_below_the_floor_is_not_certain(lead, kind):
    """Shear thinning was above the limit by 0.001; a bias of a tenth of the noise brought it below."""
    above = NoiseFloor(gap=1.031, slow=1.0)
    part = scored(["shear_thinning"], 100.0 - lead, floor=above)
    both = scored(["shear_thinning", "torque_bias"], 100.0)
    found = verdict_on(sorted((part, both), key=lambda c: c.score))
    assert (found.kind, set(found.effects)) == (kind, {"shear_thinning", "torque_bias"})
    assert (("shear_thinning",) in found.confusable) is (kind is VerdictKind.UNDECIDED)
    far = replace(part, floor=NoiseFloor(gap=1.2, slow=1.0))
    led = verdict_on(sorted((far, both), key=lambda c: c.score))
    assert (led.kind is VerdictKind.UNDECIDED) is (lead > 0)
    other = scored(["stiction"], 100.0 - lead, floor=above)  # no part of it: it explains nothing
    assert verdict_on(sorted((other, both), key=lambda c: c.score)).kind is VerdictKind.EXPLAINED


def test_what_is_above_the_noise_floor_explains_nothing():
    above = NoiseFloor(gap=2.0, slow=5.0)
    found = verdict_on([scored(["tip_drag"], 1.0, floor=above), scored([], 100.0, floor=above)])
    assert found.kind is VerdictKind.UNKNOWN
    assert not found.settled
    assert found.best.names == ("tip_drag",)
    assert dict(found.ranking)["unknown",] == 1.0


def test_what_was_not_checked_on_held_out_trials_explains_nothing():
    found = verdict_on([scored(["tip_drag"], 1.0, held_out=None)])
    assert found.kind is VerdictKind.UNKNOWN


@pytest.mark.parametrize(
    ("lead", "kind", "effects", "confusable"),
    [
        (-1, VerdictKind.NONE, (), ()),
        (1, VerdictKind.UNDECIDED, ("tip_drag",), (("tip_drag",), ())),
        (9, VerdictKind.UNDECIDED, ("tip_drag",), (("tip_drag",), ())),
        (11, VerdictKind.EXPLAINED, ("tip_drag",), ()),
    ],
)
def test_an_effect_has_to_lead_the_nominal_rig(lead, kind, effects, confusable):
    found = verdict(([], 100.0 + lead), (["tip_drag"], 100.0))
    assert (found.kind, found.effects, found.confusable) == (kind, effects, confusable)


def test_the_nominal_rig_may_be_beaten_by_two_effects_that_are_alike():
    found = verdict(([], 108.0), (["tip_angle_scale"], 100.0), (["base_angle_scale"], 101.0))
    assert (found.kind, found.effects) == (VerdictKind.UNDECIDED, ("tip_angle_scale",))
    assert set(found.confusable) == {("tip_angle_scale",), ("base_angle_scale",), ()}


@pytest.mark.parametrize("imperfections", [(), ("torque_clock",)])
def test_a_rig_whose_constants_are_off_is_named_by_no_effect_that_adds_nothing(imperfections):
    """Stiffness and damping off by 2 % for certain, and open which: an effect behind it is no rival."""
    scales = tuple(LIBRARY[name] for name in SCATTER)
    idle = [0.0] * len(imperfections)
    off = fit_of(
        imperfections,
        x=[*idle, 0.02, -0.02],
        jacobian=[[[*idle, 1e3, -1e3]] * 10],
        nuisance=scales,
    )
    ratio = replace(scored(imperfections, 100.0), fit=off)
    assert ratio.unidentifiable
    beside = fit_of(
        ("tip_drag",), x=[-3.0, 0.02, -0.02], jacobian=[[[0, 1e3, -1e3]] * 10], nuisance=scales
    )
    other = replace(scored(["tip_drag"], 101.0), fit=beside)
    found = verdict_on(
        [ratio, other, scored(["damping_error"], 102.0), scored(["stiffness_error"], 102.0)]
    )
    assert set(found.confusable) == {("damping_error",), ("stiffness_error",)}


@pytest.mark.parametrize(("left", "kind"), [(0.0, VerdictKind.UNDECIDED), (0.02, VerdictKind.EXPLAINED)])
def test_an_effect_in_place_of_a_constant_that_is_off_is_a_rival_and_one_beside_it_is_none(left, kind):
    """One whose fit leaves the damping as far off adds nothing."""
    scales = tuple(LIBRARY[name] for name in SCATTER)
    off = fit_of((), x=[0.0, 0.02], jacobian=[[[1e3, 0.0], [0.0, 1e3]] * 10], nuisance=scales)
    alone = replace(scored([], 100.0), fit=off)
    assert alone.named == ("damping_error",)
    slopes = [[[0.0, 1e3, 0.0], [0.0, 0.0, 1e3]] * 10]
    beside = fit_of(("tip_drag",), x=[-3.0, 0.0, left], jacobian=slopes, nuisance=scales)
    found = verdict_on([alone, replace(scored(["tip_drag"], 104.0), fit=beside)])
    assert (found.kind, found.effects) == (kind, ("damping_error",))


@pytest.mark.parametrize(
    ("off", "kind"), [(0.025, VerdictKind.EXPLAINED), (0.001, VerdictKind.UNDECIDED)]
)
def test_what_asks_the_rigs_constants_to_be_off_by_chance_is_named_beside_the_best(off, kind):
    scales = tuple(LIBRARY[name] for name in SCATTER)
    behind = replace(
        scored(["base_angle_scale"], 107.0),
        fit=fit_of(("base_angle_scale",), x=[0.03, off, off], nuisance=scales),
    )
    found = verdict_on([scored(["tip_angle_scale"], 100.0), behind])
    assert (found.kind, found.effects) == (kind, ("tip_angle_scale",))
    assert found.confusable == (("tip_angle_scale",), ("base_angle_scale",))


def test_probabilities_are_those_of_the_scores():
    ranking = dict(verdict((["tip_drag"], 100.0), (["entry_friction"], 104.0)).ranking)
    assert sum(ranking.values()) == pytest.approx(1.0)
    assert ranking["tip_drag",] / ranking["entry_friction",] == pytest.approx(2.718281828**2)
    assert set(ranking) == {(name,) for name in (*LIBRARY, "none", "unknown")}


def test_a_pair_is_one_row_of_the_ranking_at_its_own_probability():
    first, second = (["tip_drag", "torque_bias"], 100.0), (["torque_bias", "tip_drag"], 103.0)
    found = verdict(first, second, (["entry_friction"], 104.0))
    ranking = dict(found.ranking)
    assert sum(ranking.values()) == pytest.approx(1.0)
    pair = ranking["tip_drag", "torque_bias"]
    odds = np.exp(2.0) * (1.0 + np.exp(-1.5))  # of both fits of the pair
    assert pair / ranking["entry_friction",] == pytest.approx(odds)
    assert ranking["tip_drag",] == ranking["torque_bias",] == 0.0


def test_the_place_is_that_of_the_first_effect():
    assert places(("tip_drag", "torque_bias")) == "needle"
    assert places(()) == ""
    assert candidate(fit_of(("tip_drag",))).names == ("tip_drag",)


TOO_MUCH = NoiseFloor(gap=2.0, slow=5.0)
FAR_BEHIND = scored(["torque_bias"], 500.0)


def cut(*candidates):
    """The provisional verdict on candidates, best first."""
    return provisional(verdict_on(candidates), candidates)


@pytest.mark.parametrize("names", [(), ("tip_drag",), ("tip_drag", "torque_bias")])
def test_what_is_at_the_floor_is_never_said_to_explain_the_log(names):
    best = scored(names, 100.0)
    assert verdict_on([best]).settled
    found = cut(best)
    assert (found.kind, found.effects, found.confusable) == (VerdictKind.UNDECIDED, names, (names,))


def test_every_explanation_at_the_floor_may_be_it_the_best_first():
    found = cut(scored(["tip_drag"], 100.0), scored(["entry_friction"], 300.0), FAR_BEHIND)
    assert found.confusable == (("tip_drag",), ("entry_friction",), ("torque_bias",))


def test_an_explanation_above_the_floor_is_no_rival():
    found = cut(scored(["tip_drag"], 100.0), scored(["entry_friction"], 200.0, floor=TOO_MUCH))
    assert found.confusable == (("tip_drag",),)


def test_the_same_effects_in_another_order_are_one_set():
    one, other = scored(["tip_drag", "torque_bias"], 100.0), scored(["torque_bias", "tip_drag"], 200.0)
    assert cut(one, other).confusable == (("tip_drag", "torque_bias"),)


def test_nothing_at_the_floor_stays_unknown():
    assert cut(scored(["tip_drag"], 100.0, floor=TOO_MUCH)).kind is VerdictKind.UNKNOWN


def test_what_cannot_be_told_apart_stays_beside_a_provisional_verdict():
    best = scored(["tip_drag"], 100.0)
    found = replace(verdict_on([best]), confusable=(("tip_drag",), ("torque_bias", "entry_friction")))
    assert provisional(found, [best]).confusable == (("tip_drag",), ("torque_bias", "entry_friction"))


def test_an_explanation_that_is_refuted_is_unknown_and_stays_the_best():
    found = verdict((["layered_tissue"], 100.0), (["tip_drag"], 200.0))
    assert found.kind is VerdictKind.EXPLAINED
    changed = refuted(found, "damping that changes along the shaft")
    assert (changed.kind, changed.effects) == (VerdictKind.UNKNOWN, ())
    assert changed.best is found.best
    assert dict(changed.ranking)["unknown",] == 1.0
    assert changed.other_form == "damping that changes along the shaft"


def test_an_effect_that_may_be_hidden_leaves_the_verdict_open_with_half_of_the_probability_each():
    explained = verdict((["tip_drag"], 100.0))
    found = with_open_effects(explained, ["torque_bias"])
    assert found.kind is VerdictKind.UNDECIDED
    assert found.confusable == (("tip_drag",), ("tip_drag", "torque_bias"))
    ranking = dict(found.ranking)
    assert ranking["tip_drag",] == ranking["tip_drag", "torque_bias"] == pytest.approx(0.5)
    assert sum(ranking.values()) == pytest.approx(1.0)
    assert with_open_effects(explained, []) is explained


def test_beside_the_nominal_rig_the_hidden_effect_would_be_the_only_one():
    found = with_open_effects(verdict(([], 100.0)), ["torque_bias"])
    assert found.confusable == ((), ("torque_bias",))
    assert dict(found.ranking)["torque_bias",] == pytest.approx(0.5)


def test_nothing_is_hidden_where_nothing_explains_the_log():
    above = verdict_on([scored(["tip_drag"], 90.0, floor=NoiseFloor(gap=2.0, slow=5.0))])
    assert with_open_effects(above, ["torque_bias"]) is above


@pytest.mark.parametrize(
    ("known", "lead", "kind"),
    [
        ({"shift": 20.0}, 21.0, VerdictKind.UNDECIDED),
        ({"shift": 20.0}, 40.0, VerdictKind.EXPLAINED),
        ({"of_means": True}, 21.0, VerdictKind.UNDECIDED),
        ({}, 21.0, VerdictKind.EXPLAINED),
    ],
)
def test_a_part_that_only_shifts_or_is_known_by_means_has_to_be_led_by_more(known, lead, kind):
    both = scored(["tip_angle_bias", "layered_tissue"], 100.0)
    alone = scored(["tip_angle_bias"], 100.0 + lead, **known)
    found = verdict_on([both, alone])
    assert found.kind is kind
    assert (("tip_angle_bias",) in found.confusable) is (kind is VerdictKind.UNDECIDED)


def test_a_likelier_richer_form_that_only_shifts_is_open():
    """Rough stick and slip differs from trial to trial; what it contains is then no certain answer."""
    simple = scored(["coulomb_friction"], 151.0)
    richer = scored(["stiction"], 100.0, shift=33.0)
    assert verdict_on([richer, simple]).kind is VerdictKind.UNDECIDED
    unrelated = scored(["tip_drag"], 100.0, shift=33.0)
    assert verdict_on([unrelated, simple]).kind is VerdictKind.EXPLAINED


def test_a_part_that_names_the_same_leaves_nothing_open():
    """Without the clock, trials shift: drive friction is the answer with it or without it."""
    both, alone = scored(["drive_friction", "torque_clock"], 100.0), scored(["drive_friction"], 95.0)
    found = verdict_on([replace(alone, shift=13.0), both])
    assert (found.kind, found.confusable) == (VerdictKind.EXPLAINED, ())


def test_an_imperfection_that_nothing_asks_for_does_not_excuse_a_clear_shift():
    """Damping that grows with the axial speed was told as two wrong constants beside a clock."""
    both, alone = scored(["damping_error", "tip_clock"], 100.0), scored(["damping_error"], 95.0)
    assert verdict_on([replace(alone, shift=20.0), both]).kind is VerdictKind.UNKNOWN
    asked = replace(alone, score=105.0, shift=20.0)  # the clock takes off more than it costs
    assert verdict_on([both, asked]).kind is VerdictKind.EXPLAINED


@pytest.mark.parametrize(
    ("ahead", "nearest"), [(0.001, "coulomb_friction"), (2.0, "speed_dependent_friction")]
)
def test_of_two_that_are_equally_near_always_the_same_one_is_named(ahead, nearest):
    """Rounding decides which of them a fit leaves ahead."""
    above = {"floor": NoiseFloor(gap=2.0, slow=5.0)}
    names = ("speed_dependent_friction", "coulomb_friction")
    each = [scored([n], 90.0 + i * ahead, **above) for i, n in enumerate(names)]
    assert verdict_on(each).best.names == (nearest,)
