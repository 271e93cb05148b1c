"""What a diagnosis says in sentences."""

from dataclasses import replace
from types import SimpleNamespace

import pytest
from free_forms import missing_with

from diagnosis.assessment.advice import advise
from diagnosis.effects import LIBRARY
from diagnosis.fitting.noise_floor import NoiseFloor
from diagnosis.in_sigma import in_sigma
from diagnosis.prepare.prepare import prepare
from diagnosis.report.sentences import (
    alike,
    best_in_words,
    by_free_law,
    explanation_name,
    explanations,
    headline,
    label_of,
    largest_parts,
    largest_residual,
    leading,
    nearest,
    reduction,
    replay_quality,
    titles,
    with_one_more,
)
from diagnosis.residuals.lead import Lead
from diagnosis.selection.verdicts.verdict import VerdictKind
from diagnosis.stopping import EarlyStop


def concluding(found, **verdict):
    """The diagnosis with another verdict."""
    return replace(found, verdict=replace(found.verdict, **verdict))


def test_what_explains_the_gap_is_the_headline(dry):
    gap = dry.found.assessment.gap
    expected = (
        "Dry (Coulomb) friction along the shaft explains the gap: residual "
        f"{in_sigma(gap.before)} → {in_sigma(gap.after)} (σ = sensor noise)"
    )
    assert headline(dry.found) == expected


def test_where_another_form_of_the_law_leaves_less_the_headline_says_which(dry):
    unknown = concluding(
        dry.found, kind=VerdictKind.UNKNOWN, effects=(), other_form="friction that wears off"
    )
    said = headline(unknown)
    assert said.startswith(f"Unknown: residual {in_sigma(dry.found.assessment.gap.before)}. ")
    assert said.endswith("σ (σ = sensor noise), but friction that wears off leaves clearly less")


TWO = ("tip_drag", "torque_bias")


@pytest.mark.parametrize(
    ("verdict", "said"),
    [
        ({"kind": VerdictKind.NONE, "effects": ()}, "No gap beyond noise: the nominal model explains"),
        ({"effects": TWO}, "explain the gap: residual"),
        (
            {"kind": VerdictKind.UNDECIDED, "confusable": (("tip_drag",), ("torque_bias",))},
            "Undecided: these explain the gap equally well:",
        ),
        ({"kind": VerdictKind.UNKNOWN, "effects": ()}, "Unknown: no effect of the library"),
    ],
)
def test_every_verdict_has_its_headline(dry, verdict, said):
    assert said in headline(concluding(dry.found, **verdict))


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


def test_of_a_search_that_was_cut_short_the_nearest_is_that_of_what_was_tried(dry):
    found = replace(concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=()), stopped=SEARCH)
    assert "No explanation that was tried so far reaches the noise" in nearest(found)


def test_a_numerical_error_that_was_not_looked_at_is_told_as_that(dry):
    told = replace(dry.found.assessment, numerical_error={})
    lines = replay_quality(replace(dry.found, assessment=told))
    assert [line.endswith("numerical error: not computed") for line in lines] == [True, True, False]


def test_what_comes_nearest_is_told_of_an_unknown_log_alone(dry):
    assert nearest(dry.found) == ""
    said = nearest(concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=()))
    assert said.startswith(
        "Nearest: dry (Coulomb) friction along the shaft (coulomb_friction level 0.00"
    )
    assert "% of the power of the gap" in said
    assert "the remaining residual is largest in " in said


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


def test_what_would_leave_little_but_does_not_count_is_told_with_its_power(dry):
    far = NoiseFloor(gap=1.01, slow=1.5)
    best = replace(dry.found.verdict.best, floor=far)
    found = concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=(), best=best)
    told = headline(found)
    power = f"{found.assessment.nearest.power_explained_percent:.0f} % of its power"
    assert told.startswith(f"Unknown: residual {in_sigma(found.assessment.gap.before)}. Dry (Coulomb)")
    assert f"and explain {power}, but does not count: not white" in told


def test_what_the_named_effect_cannot_be_told_from_stands_beside_it(dry):
    assert alike(dry.found) == ""
    said = alike(concluding(dry.found, confusable=(("coulomb_friction",), TWO, ("stiction",))))
    assert said.startswith(f"Cannot be told from: {titles(TWO)}; or {titles(('stiction',))}. ")
    kind = VerdictKind.UNDECIDED  # whose headline says it
    assert alike(concluding(dry.found, kind=kind, confusable=(TWO, ("stiction",)))) == ""


def test_explanations_are_the_ranking_without_what_rounds_to_nothing(dry):
    assert explanations(dry.found)[0][0] == "coulomb_friction"
    assert sum(p for _, p in dry.found.verdict.ranking) == pytest.approx(1.0)
    unknown = concluding(dry.found, ranking=((("unknown",), 1.0), (("none",), 0.0)))
    assert explanations(unknown) == [("unknown", 1.0)]
    assert explanation_name(("torque_bias", "tip_drag")) == explanation_name(TWO)
    assert explanation_name(()) == "none"


def test_one_trial_is_not_called_held_out(dry):
    alone = replace(dry.found, log=replace(dry.found.log, trials=dry.found.log.trials[:1]))
    assert "held-out" in reduction(dry.found)
    assert "held-out" not in reduction(alone)
    assert "which is also the one that was fitted" in reduction(alone)


def test_the_reduction_is_told_with_its_interval(dry):
    gap = dry.found.assessment.gap
    said = reduction(dry.found)
    assert f"from {in_sigma(gap.before)} to {in_sigma(gap.after)}" in said
    assert f"{100 * gap.shrink_low:.1f} to {100 * gap.shrink_high:.1f} %" in said


def test_what_stays_as_it_is_does_not_fall(dry):
    told = dry.found.assessment
    gap = replace(told.gap, before=1.0, after=0.9996, shrink=0.0004, shrink_low=0.0, shrink_high=0.001)
    same = replace(told, gap=gap, breakdown_after=told.breakdown)
    found = replace(dry.found, assessment=same)
    assert "the residual is 1.00 σ. 1 σ is the noise floor." in reduction(found)
    assert largest_parts(found) == f"Residual of the nominal model: {told.breakdown.largest}"


def test_the_best_of_an_unknown_log_is_called_no_explanation(dry):
    unknown = replace(dry.found, verdict=replace(dry.found.verdict, kind=VerdictKind.UNKNOWN))
    called = {found.verdict.kind: label_of(found, "explained") for found in (dry.found, unknown)}
    assert called == {VerdictKind.EXPLAINED: "explained", VerdictKind.UNKNOWN: "nearest"}
    assert label_of(unknown, "nominal") == "nominal"
    assert best_in_words(dry.found) == "the best explanation"
    assert "; of what comes nearest: largest in" in largest_parts(unknown)


def test_what_is_with_a_free_form_law_is_called_that(dry):
    unknown = concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=())
    found, without = (replace(unknown, missing=m) for m in (missing_with(), missing_with(law=None)))
    assert [by_free_law(one) for one in (found, without, dry.found)] == [True, False, False]
    assert label_of(found, "explained") == "free-form law"
    assert label_of(without, "explained") == "nearest"
    assert label_of(found, "nominal") == "nominal"
    assert "; of the free-form law: largest in" in largest_parts(found)
    # The parts of the residual that is left are those of the law, not of what comes nearest.
    assert "the remaining residual is" not in nearest(found)
    assert "the remaining residual is" in nearest(without)


def test_an_unknown_log_is_told_with_the_gap_of_the_nearest_not_of_the_law(dry):
    told = replace(dry.found.assessment, gap=replace(dry.found.assessment.gap, after=0.5))
    found = replace(concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=()), assessment=told)
    near = found.assessment.nearest.gap_after
    assert f"at best {in_sigma(near)}" in headline(replace(found, missing=missing_with()))


@pytest.mark.parametrize(("times", "told"), [(3.0, True), (1.0, False)])
def test_trials_that_fit_together_and_not_from_each_other_may_differ(dry, times, told):
    best = dry.found.verdict.best
    near = replace(dry.found.assessment.nearest, gap_after=times * best.fit.gap)
    found = concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=())
    found = replace(found, assessment=replace(dry.found.assessment, nearest=near))
    left, unseen = in_sigma(best.fit.gap), in_sigma(near.gap_after)
    said = f"{left} of all trials together, but predictions from the other trials {unseen}"
    assert (said in headline(found)) is told


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
    assert "which none of them lowers" in headline(found)
    assert "at best" not in headline(found)


def test_one_more_effect_that_changes_nothing_is_said_to(dry):
    found = dry.found
    assert "Adding another effect changes almost nothing" in with_one_more(found)
    here = found.verdict.best.fit.gap
    told = replace(found.assessment, with_one_more={"tip_drag": 0.5 * here})
    assert "would lower the residual" in with_one_more(replace(found, assessment=told))
    best = replace(
        found.verdict.best, fit=replace(found.verdict.best.fit, cost=400.0 * found.verdict.best.fit.cost)
    )
    far = concluding(
        replace(found, assessment=replace(told, with_one_more={"tip_drag": 19.95 * here})), best=best
    )
    assert "changes almost nothing" in with_one_more(far)
    nothing = replace(found.assessment, with_one_more={})
    assert with_one_more(replace(found, assessment=nothing)) == ""


def test_noise_and_numerical_error_are_told_by_sensor(dry):
    lines = replay_quality(dry.found)
    assert [line.split(":")[0] for line in lines] == [
        "base_torque_n_mm",
        "tip_angle_deg",
        "base_angle_deg",
    ]
    assert "numerical error: 0.0" in lines[0]


def test_the_largest_residual_is_told_with_where_it_is(dry):
    stretch, value = dry.found.assessment.breakdown.worst
    assert (
        largest_residual(dry.found)
        == f"Largest residual of the nominal model: {in_sigma(value)}, {stretch}"
    )


def test_table_sentence_and_advice_name_the_same_parts_with_the_same_numbers(dry):
    """What is said of an unknown effect, of the largest numbers of the tables before and after."""
    told = dry.found.assessment
    unknown = concluding(dry.found, kind=VerdictKind.UNKNOWN).verdict
    problem = SimpleNamespace(log=prepare(dry.found.log)[0])
    advice = advise(problem, unknown, told.breakdown, told.breakdown_after, {})
    for parts in (told.breakdown, told.breakdown_after):
        signal = max(parts.signal, key=parts.signal.get)
        phase = max(parts.phase, key=parts.phase.get)
        assert f"largest in {signal} ({in_sigma(parts.signal[signal])}) and" in parts.largest
        assert parts.largest.endswith(f"({in_sigma(parts.phase[phase])})")
        assert parts.largest in advice
        assert parts.largest in largest_parts(dry.found)


LEAD = Lead(signal="tip_angle_deg", by_s=0.1, low_s=0.05, high_s=0.2, correlation=-0.9, chance_limit=0.2)


@pytest.mark.parametrize(
    ("lead", "said"),
    [
        (LEAD, "The residual of tip_angle_deg leads that of base_torque_n_mm by 100 ms (95 % interval"),
        (replace(LEAD, signal="", low_s=-0.05), "perhaps that of base_torque_n_mm, by"),
        (replace(LEAD, signal="", correlation=0.1), "correlation of 0.10 is within chance (0.20)"),
        (None, "needs both sensors"),
    ],
)
def test_which_signal_leads_is_said_or_why_it_cannot_be(dry, lead, said):
    shape = replace(dry.found.assessment.shape, leads=lead)
    sentence = leading(replace(dry.found, assessment=replace(dry.found.assessment, shape=shape)))
    assert said in sentence
    assert ("not clear" in sentence) == (lead is None or not lead.signal)
