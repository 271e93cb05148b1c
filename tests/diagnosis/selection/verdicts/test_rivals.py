"""What may be true in place of the best explanation, whose scores are given."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import fit_of, held, scored, verdict_of

from diagnosis.criteria.fitting import SCATTER
from diagnosis.criteria.selection import PART_LEAD
from diagnosis.effects import LIBRARY
from diagnosis.fitting.noise_floor import NoiseFloor
from diagnosis.selection.scoring.complexity import choice_penalty
from diagnosis.selection.verdicts.decision import verdict_on
from diagnosis.selection.verdicts.rivals import (
    certain_lead,
    differ_in_one_form,
    says,
    says_something_else,
)
from diagnosis.selection.verdicts.verdict import VerdictKind

SCALES = tuple(LIBRARY[name] for name in SCATTER)


@pytest.mark.parametrize(
    ("begun_late", "of_prior", "certain"),
    [(False, 0.0, 12.0), (True, 0.0, 2.0), (True, 12.0, 12.0), (True, 5.0, 5.0)],
    ids=["from rest", "late", "a matter of the prior", "partly"],
)
def test_what_the_past_of_late_trials_may_have_made_of_a_lead_does_not_count(
    begun_late, of_prior, certain
):
    best = scored(["base_angle_scale"], 100.0, begun_late=begun_late)
    fit = fit_of(["tip_angle_scale"], nuisance=SCALES)
    weights = fit.parameterization.weights
    off = np.sqrt(of_prior / np.count_nonzero(weights))
    x = np.where(weights > 0.0, off / np.maximum(weights, 1e-9), fit.x)
    other = replace(scored(["tip_angle_scale"], 112.0), fit=replace(fit, x=x))
    assert other.fit.prior == pytest.approx(of_prior)
    assert certain_lead(best, other, 100.0) == pytest.approx(certain)


def test_what_more_effects_cost_is_no_matter_of_the_past_of_late_trials():
    """Two effects in place of one that fit as well are behind by what the choice of a pair costs."""
    best = scored(["tip_angle_scale"], 100.0, begun_late=True)
    names = ["base_angle_scale", "torque_scale"]
    more = choice_penalty(names) - choice_penalty(best.names)
    assert more > 5.0
    assert certain_lead(best, scored(names, 100.0 + more), 100.0) == pytest.approx(more)
    assert certain_lead(best, scored(names, 103.0 + more), 100.0) == pytest.approx(more)


@pytest.mark.parametrize(("lead", "beside"), [(8, True), (12, False)])
def test_a_richer_form_that_nothing_asks_for_but_fits_is_named_beside(lead, beside):
    found = verdict_of((["coulomb_friction"], 100.0), (["stiction"], 100.0 + lead))
    assert (("stiction",) in found.confusable) is beside


def test_a_second_effect_has_to_lead_the_first_alone():
    near = verdict_of((["tip_drag"], 108.0), (["tip_drag", "torque_bias"], 100.0))
    assert (near.kind, near.effects) == (VerdictKind.EXPLAINED, ("tip_drag",))
    far = verdict_of((["tip_drag"], 112.0), (["tip_drag", "torque_bias"], 100.0))
    assert set(far.effects) == {"tip_drag", "torque_bias"}


def test_a_richer_form_with_a_second_effect_needs_the_wider_margin():
    near = verdict_of((["coulomb_friction"], 108.0), (["stiction", "torque_bias"], 100.0))
    assert (near.kind, near.effects) == (VerdictKind.EXPLAINED, ("coulomb_friction",))
    far = verdict_of((["coulomb_friction"], 112.0), (["stiction", "torque_bias"], 100.0))
    assert set(far.effects) == {"stiction", "torque_bias"}


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


ABOVE = NoiseFloor(gap=2.0, slow=5.0)


def test_what_is_as_good_as_none_explains_nothing_but_leaves_open_what_it_leads():
    """Shear thinning of an exponent of 0.995, which dry friction replaces less well."""
    x = [0.995, 0.0]
    weak = replace(scored(["shear_thinning"], 60.0), fit=fit_of(("shear_thinning",), x=x))
    assert weak.as_good_as_none
    found = verdict_on([weak, scored(["coulomb_friction"], 100.0)])
    assert (found.kind, found.effects) == (VerdictKind.UNDECIDED, ("coulomb_friction",))
    assert ("shear_thinning",) in found.confusable
    only = verdict_on([weak, replace(scored(["coulomb_friction"], 100.0), floor=ABOVE)])
    assert (only.kind, only.effects) == (VerdictKind.EXPLAINED, ("shear_thinning",))
    beside = replace(
        scored(["tip_drag", "shear_thinning"], 60.0),
        fit=fit_of(("tip_drag", "shear_thinning"), x=[-3.0, *x]),
    )
    alone = verdict_on([beside, scored(["tip_drag"], 100.0)])
    assert (alone.kind, alone.effects) == (VerdictKind.EXPLAINED, ("tip_drag",))


@pytest.mark.parametrize(
    ("scale", "effects"), [(0.998, ("damping_error",)), (0.99, ("damping_error", "torque_scale"))]
)
def test_a_torque_gain_is_named_beside_an_effect_from_where_stiffness_and_damping_are(scale, effects):
    both = replace(
        scored(["damping_error", "torque_scale"], 60.0),
        fit=fit_of(("damping_error", "torque_scale"), x=[0.1, np.log(scale)]),
    )
    found = verdict_on([both, scored(["damping_error"], 100.0)])
    assert (found.kind, found.effects) == (VerdictKind.EXPLAINED, effects)


def test_what_is_held_by_a_bound_and_above_the_noise_leaves_nothing_open():
    far = replace(held(["base_compliance"], 1.0), floor=ABOVE)
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


@pytest.mark.parametrize(
    ("known", "lead", "kind"),
    [
        ({"shift": 20.0}, 21.0, VerdictKind.UNDECIDED),
        ({"shift": 20.0}, 40.0, VerdictKind.EXPLAINED),
        ({"means_of": 2}, 21.0, VerdictKind.UNDECIDED),
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


def test_an_imperfection_of_a_sensor_is_something_that_is_said():
    assert says(scored(["tip_drag", "torque_low_pass"], 1.0)) == ("tip_drag", "torque_low_pass")
    assert says(scored([], 1.0)) == ()


def test_the_best_with_more_beside_it_says_nothing_else_and_other_effects_do():
    best, more, other = (
        scored(names, 1.0) for names in (["tip_drag"], ["tip_drag", "torque_bias"], ["torque_bias"])
    )
    assert not says_something_else(best, more)
    assert says_something_else(best, other)


@pytest.mark.parametrize(
    ("one", "other", "differ"),
    [
        (["coulomb_friction"], ["stiction"], True),
        (["coulomb_friction", "tip_drag"], ["stiction", "tip_drag"], True),
        (["coulomb_friction"], ["stiction", "tip_drag"], False),
        (["coulomb_friction"], ["torque_bias"], False),
    ],
)
def test_forms_are_of_one_law(one, other, differ):
    assert differ_in_one_form(scored(one, 1.0), scored(other, 1.0)) is differ


@pytest.mark.parametrize(
    ("lead", "kind"), [(400.0, VerdictKind.UNDECIDED), (600.0, VerdictKind.EXPLAINED)]
)
def test_what_leads_nothing_by_what_no_model_resolves_is_not_certain(lead, kind):
    best = replace(scored(["layered_tissue"], 100.0), unresolved_cost=500.0)
    found = verdict_on([best, scored([], 100.0 + lead)])
    assert (found.kind, found.effects) == (kind, ("layered_tissue",))
