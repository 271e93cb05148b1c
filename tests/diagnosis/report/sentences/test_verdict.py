"""The verdict in one sentence."""

from dataclasses import replace

import pytest
from diagnosis_fixtures import concluding
from free_forms import missing_with

from diagnosis.effects import LIBRARY
from diagnosis.fitting.noise_floor import NoiseFloor
from diagnosis.in_sigma import in_sigma
from diagnosis.report.sentences.names import titles
from diagnosis.report.sentences.verdict import alike, headline
from diagnosis.selection.verdicts.verdict import VerdictKind
from diagnosis.stopping import EarlyStop


def test_what_explains_the_gap_is_the_headline(dry):
    gap = dry.found.assessment.gap
    expected = (
        "Dry (Coulomb) friction along the shaft explains the gap: residual "
        f"{in_sigma(gap.before)} → {in_sigma(gap.after)} (σ = sensor noise)"
    )
    assert headline(dry.found) == expected


def test_where_another_form_of_the_law_leaves_less_the_headline_says_which(dry):
    unknown = concluding(
        dry.found, kind=VerdictKind.UNKNOWN, effects=(), other_form="friction that wears off leaves less"
    )
    said = headline(unknown)
    assert said.startswith(f"Unknown: residual {in_sigma(dry.found.assessment.gap.before)}. ")
    assert said.endswith("σ (σ = sensor noise), but friction that wears off leaves less")


TWO = ("tip_drag", "torque_bias")


@pytest.mark.parametrize(
    ("verdict", "said"),
    [
        ({"kind": VerdictKind.NONE, "effects": ()}, "No gap beyond noise: the nominal model explains"),
        ({"effects": TWO}, "explain the gap: residual"),
        (
            {"kind": VerdictKind.UNDECIDED, "confusable": (("tip_drag",), ("torque_bias",))},
            "Undecided: any of these may explain the gap:",
        ),
        (
            {"kind": VerdictKind.UNKNOWN, "effects": ()},
            "Unknown: nothing in the library explains the gap, alone or together: residual",
        ),
    ],
)
def test_every_verdict_has_its_headline(dry, verdict, said):
    assert said in headline(concluding(dry.found, **verdict))


def test_a_gap_that_is_all_of_the_sensors_is_told_as_one(dry):
    """The nominal column of the table is far above the noise then."""
    sensors = replace(dry.found.assessment.sensors, drift_sigma={"base_torque_n_mm": 5.0})
    nothing = concluding(dry.found, kind=VerdictKind.NONE, effects=())
    told = headline(replace(nothing, assessment=replace(nothing.assessment, sensors=sensors)))
    assert "lacks nothing; all of the gap is in the sensors: a drift of the torque sensor" in told
    assert told.endswith(
        f"With that allowed for, the nominal model leaves {in_sigma(dry.found.assessment.gap.after)} "
        "(σ = sensor noise)"
    )


@pytest.mark.parametrize(("power", "told"), [(0.4, "less than 1 %"), (1.4, "1 %")])
def test_next_to_no_power_is_told_as_that(dry, power, told):
    near = replace(dry.found.assessment.nearest, power_explained_percent=power)
    found = concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=())
    found = replace(found, assessment=replace(dry.found.assessment, nearest=near))
    assert f"{told} of its power" in headline(found)


SEARCH = EarlyStop(why="limit of 30 s", stage="fitting pairs", left_out=("pairs",), search=True)


BEGINNING = "Stopped early (limit of 30 s, while fitting pairs): best so far: "


@pytest.mark.parametrize(
    ("verdict", "said"),
    [
        (
            {"kind": VerdictKind.UNDECIDED, "confusable": (("tip_drag",), ())},
            f"{titles(['tip_drag'])}; or the nominal model as it is: undecided, because others were",
        ),
        (
            {"kind": VerdictKind.UNKNOWN, "effects": ()},
            "dry (Coulomb) friction along the shaft, which does not explain the gap",
        ),
    ],
)
def test_a_search_that_was_cut_short_has_its_headline(dry, verdict, said):
    found = replace(concluding(dry.found, **verdict), stopped=SEARCH)
    assert headline(found).startswith(BEGINNING + said)


def test_a_verdict_that_stands_has_its_own_headline_after_a_stop(dry):
    found = replace(dry.found, stopped=replace(SEARCH, search=False))
    assert headline(found) == BEGINNING + headline(dry.found)


def test_what_a_stop_left_out_is_a_warning(dry):
    assert dry.found.warnings == ()
    cut, whole = (replace(dry.found, stopped=replace(SEARCH, search=s)) for s in (True, False))
    assert cut.warnings[0].startswith(
        "stopped early (limit of 30 s); not done, or not to the end: pairs; what was not tried"
    )
    assert "not tried" not in whole.warnings[0]


def test_sets_that_fit_alike_are_told_in_words(dry):
    kind = VerdictKind.UNDECIDED
    said = headline(concluding(dry.found, kind=kind, confusable=(TWO, ("stiction",))))
    assert f"{titles(TWO)}; or {titles(('stiction',))}" in said


@pytest.mark.parametrize(
    ("count", "said"), [(5, ""), (7, "; or one of 3 others, which report.json lists")]
)
def test_of_many_sets_that_fit_alike_the_first_are_told(dry, count, said):
    sets = tuple((name,) for name in list(LIBRARY)[:count])
    told = headline(concluding(dry.found, kind=VerdictKind.UNDECIDED, confusable=sets))
    assert ("others" in told) is bool(said)
    assert said in told
    assert titles(sets[3]) in told


def test_what_the_sensors_do_beside_the_nearest_explanation_is_told_with_it(dry):
    near = replace(dry.found.assessment.nearest, imperfections=("tip_clock",))
    found = concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=())
    found = replace(found, assessment=replace(dry.found.assessment, nearest=near))
    named = titles(near.effects)
    assert f"with {named}, beside a clock of the tip sensor that drifts, which explains" in headline(
        found
    )


def test_where_a_law_closes_the_gap_what_comes_nearest_is_left_to_its_table(dry):
    """It has the names of the effects, and what the sensors do."""
    found = concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=())
    found = replace(found, missing=missing_with())
    near = found.assessment.nearest
    told = headline(found)
    assert told.endswith(
        f"alone or together: residual {in_sigma(found.assessment.gap.before)}, at best "
        f"{in_sigma(near.gap_after)} (σ = sensor noise)"
    )
    assert titles(near.effects) in headline(replace(found, missing=missing_with(closed=False)))


def test_what_would_leave_little_but_does_not_count_is_told_with_its_power(dry):
    far = NoiseFloor(gap=1.01, slow=1.5)
    best = replace(dry.found.verdict.best, floor=far, shift=20.2)
    found = concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=(), best=best)
    told = headline(found)
    power = f"{found.assessment.nearest.power_explained_percent:.0f} % of its power"
    assert told.startswith(f"Unknown: residual {in_sigma(found.assessment.gap.before)}. Dry (Coulomb)")
    assert f"and explain {power}, but does not count: not white" in told
    assert "; predictions of held-out trials shift by 20.2 times" in told


def test_what_the_named_effect_cannot_be_told_from_stands_beside_it(dry):
    assert alike(dry.found) == ""
    said = alike(concluding(dry.found, confusable=(("coulomb_friction",), TWO, ("stiction",))))
    assert said.startswith(f"Cannot be told from: {titles(TWO)}; or {titles(('stiction',))}. ")
    kind = VerdictKind.UNDECIDED  # whose headline says it
    assert alike(concluding(dry.found, kind=kind, confusable=(TWO, ("stiction",)))) == ""


def test_an_unknown_log_is_told_with_the_gap_of_the_nearest_not_of_the_law(dry):
    told = replace(dry.found.assessment, gap=replace(dry.found.assessment.gap, after=0.5))
    found = replace(concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=()), assessment=told)
    near = found.assessment.nearest.gap_after
    assert f"at best {in_sigma(near)}" in headline(replace(found, missing=missing_with()))


@pytest.mark.parametrize(("times", "told"), [(3.0, True), (1.0, False)])
def test_trials_that_fit_together_and_not_from_each_other_may_differ(dry, times, told):
    near = replace(dry.found.assessment.nearest, gap_after=times * 2.4)
    found = concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=())
    found = replace(found, assessment=replace(dry.found.assessment, nearest=near, fitted_gap=2.4))
    left, unseen = in_sigma(2.4), in_sigma(near.gap_after)
    said = f"{left} of all trials together, but predictions from the other trials {unseen}"
    assert (said in headline(found)) is told
    check = ": check whether all were recorded on the same rig"
    assert (check in headline(found)) is told
    closing = replace(missing_with(), closed=True)
    assert check not in headline(replace(found, missing=closing))  # one rig explains all trials then


@pytest.mark.parametrize("times", [3.0, 300.0])
def test_sigma_is_no_noise_where_rig_yaml_states_far_less(dry, times):
    claims = dry.found.log.rig.sensors
    quieter = claims.but(tip_angle_noise_deg=dry.found.noise["tip_angle_deg"] / times)
    rig = dry.found.log.rig.but(sensors=quieter)
    told = headline(replace(dry.found, log=replace(dry.found.log, rig=rig)))
    assert ("(σ = sensor noise)" in told) is (times < 10.0)
    assert ("300 times the noise in rig.yaml" in told) is (times > 10.0)


def test_an_unknown_log_that_nothing_comes_nearer_to_has_no_best(dry):
    near = replace(dry.found.assessment.nearest, effects=())
    told = replace(dry.found.assessment, nearest=near)
    found = replace(concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=()), assessment=told)
    assert "which nothing that was tried lowers on trials that the fit has not seen" in headline(found)
    assert "at best" not in headline(found)
