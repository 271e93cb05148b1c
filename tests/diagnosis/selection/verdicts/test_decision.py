"""What is concluded from candidates whose scores are given."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import FITTED_SAMPLES, fit_of, scored, verdict_of

from diagnosis.criteria.fitting import SCATTER
from diagnosis.effects import LIBRARY
from diagnosis.fitting.noise_floor import NoiseFloor
from diagnosis.selection.candidate import candidate
from diagnosis.selection.verdicts.decision import verdict_on
from diagnosis.selection.verdicts.verdict import VerdictKind


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
    found = verdict_of((["coulomb_friction"], 100.0), (["stiction"], 100.0 - lead))
    assert (found.kind, found.effects) == (kind, effects)
    if kind is VerdictKind.UNDECIDED:
        assert set(found.confusable) == {("coulomb_friction",), ("stiction",)}


def test_of_unrelated_effects_the_one_with_more_parameters_may_be_the_best():
    """What they cost is in the score."""
    found = verdict_of((["base_compliance"], 103.0), (["layered_tissue"], 100.0))
    assert (found.kind, found.effects) == (VerdictKind.UNDECIDED, ("layered_tissue",))


@pytest.mark.parametrize(("lead", "kind"), [(8, VerdictKind.UNDECIDED), (12, VerdictKind.EXPLAINED)])
def test_unrelated_effects_are_told_apart_by_more(lead, kind):
    found = verdict_of((["tip_drag"], 100.0), (["entry_friction"], 100.0 + lead))
    assert found.kind is kind
    assert found.effects == ("tip_drag",)


@pytest.mark.parametrize(
    ("begun_late", "lead", "kind"),
    [
        (True, 12, VerdictKind.UNDECIDED),
        (True, 22, VerdictKind.EXPLAINED),
        (False, 12, VerdictKind.EXPLAINED),
    ],
)
def test_where_trials_began_late_more_of_a_lead_is_asked_for(begun_late, lead, kind):
    best = scored(["tip_drag"], 100.0, begun_late=begun_late)
    found = verdict_on([best, scored(["inserted_offset"], 100.0 + lead, begun_late=begun_late)])
    assert (found.kind, found.effects) == (kind, ("tip_drag",))


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
    found = verdict_of(([], 100.0 + lead), (["tip_drag"], 100.0))
    assert (found.kind, found.effects, found.confusable) == (kind, effects, confusable)


def test_the_nominal_rig_may_be_beaten_by_two_effects_that_are_alike():
    found = verdict_of(([], 108.0), (["tip_angle_scale"], 100.0), (["base_angle_scale"], 101.0))
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


@pytest.mark.parametrize(
    ("gap", "leaves", "named"),
    [(30.0, 1.01, "coulomb_friction"), (30.0, 1.03, "stiction"), (1.2, 1.01, "stiction")],
    ids=["hardly more", "more", "near the noise"],
)
def test_far_above_the_noise_the_plainer_of_what_leaves_hardly_more_is_nearest(gap, leaves, named):
    def left(name, own):
        return candidate(fit_of((name,), by_trial=[np.full(FITTED_SAMPLES, own)]))

    each = sorted((left("stiction", gap), left("coulomb_friction", leaves * gap)), key=lambda c: c.score)
    assert each[0].names == ("stiction",)
    assert verdict_on(each).best.names == (named,)


@pytest.mark.parametrize(
    ("part", "lead", "effects"),
    [
        (["sheath_friction"], 40.0, ("sheath_friction",)),
        (["sheath_friction"], 60.0, ("entry_friction", "sheath_friction")),
        (["base_compliance"], 40.0, ("entry_friction", "sheath_friction")),
        ([], 40.0, ("entry_friction", "sheath_friction")),
    ],
)
def test_a_part_is_named_where_no_more_leads_it_than_laws_leave_open(part, lead, effects):
    best = scored(["entry_friction", "sheath_friction"], 100.0, unresolved_law_cost=50.0)
    found = verdict_on([best, scored(part, 100.0 + lead)])
    assert (found.kind, found.effects) == (VerdictKind.EXPLAINED, effects)
    assert found.ranking[0][0] == effects
