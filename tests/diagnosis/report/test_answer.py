"""The answer in three parts, for every verdict."""

from dataclasses import replace

import pytest
from free_forms import missing_with

from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.freeform.missing.in_words import what_is_missing
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.report.answer import answer
from diagnosis.report.sentences.names import titles
from diagnosis.report.sentences.verdict import alike, headline
from diagnosis.selection.verdicts.verdict import VerdictKind
from diagnosis.stopping import EarlyStop

STOPPED = EarlyStop(why="limit of 30 s", stage="fitting pairs", left_out=("pairs",), search=True)
ALIKE = (("coulomb_friction",), ("tip_drag", "torque_bias"), ("stiction",))


def concluding(found, advice="", **verdict):
    """The diagnosis with another verdict and advice."""
    told = replace(found.assessment, next_experiment=advice)
    return replace(found, verdict=replace(found.verdict, **verdict), assessment=told)


def test_what_is_explained_is_told_with_probability_share_and_what_to_change(dry):
    what, sure, then = answer(dry.found)
    assert what == f"{headline(dry.found)}."
    assert sure.startswith("Probability 0.99")
    assert "it explains 100.0 % of the power of the residual beyond noise, on trials that the" in sure
    assert then == f"Next: {dry.found.assessment.next_experiment}."
    assert "Next: add dry friction of 0.001" in then


def test_what_cannot_be_told_from_it_is_in_the_second_sentence(dry):
    _, sure, _ = answer(concluding(dry.found, confusable=ALIKE))
    assert sure.endswith(
        f"distinguishes it from {titles(('tip_drag', 'torque_bias'))}, or {titles(('stiction',))}."
    )


def test_where_only_a_late_sensor_is_open_what_is_sure_is_told(dry):
    sets = (("coulomb_friction",), ("coulomb_friction", "torque_sensor_delay"))
    _, sure, _ = answer(concluding(dry.found, kind=VerdictKind.UNDECIDED, confusable=sets))
    assert sure.startswith(
        f"Sure of {titles(('coulomb_friction',))}; open is only whether a sensor is late: a filter"
    )
    others = (*sets, ("stiction",))
    _, sure, _ = answer(concluding(dry.found, kind=VerdictKind.UNDECIDED, confusable=others))
    assert sure.startswith("Sure that it is one of these, but not which one (probability of the first")


def test_a_sensor_that_is_all_of_the_gap_is_to_be_fixed(dry):
    nothing = concluding(dry.found, kind=VerdictKind.NONE, effects=())
    sensors = replace(nothing.assessment.sensors, drift_sigma={"base_torque_n_mm": 5.0})
    _, _, then = answer(replace(nothing, assessment=replace(nothing.assessment, sensors=sensors)))
    assert then.startswith(
        "Next: fix the sensors, or allow for what they do; the model need not change;"
    )


def test_what_may_be_there_beside_nothing_is_in_the_second_sentence(dry):
    alike = ((), ("coulomb_friction",))
    nothing = concluding(dry.found, kind=VerdictKind.NONE, effects=(), confusable=alike)
    _, sure, _ = answer(nothing)
    assert sure.endswith(
        f"no reading of this log distinguishes it from {titles(('coulomb_friction',))}."
    )


def test_a_constant_that_would_do_the_same_is_in_the_second_sentence_and_beside_the_alternatives(dry):
    """A free shaft that is longer by its rigidity / stiffness is the same spring."""
    rigidity = NOMINAL.needle(dry.found.log.rig).rigidity_n_mm2
    stiffness = Interval(
        value=rigidity / 12.0, low=0.9 * rigidity, high=1.1 * rigidity, unit="N mm / rad"
    )
    spring = concluding(dry.found, effects=("base_compliance",), confusable=())
    parameters = {"base_compliance": {"stiffness": stiffness}}
    spring = replace(spring, assessment=replace(spring.assessment, parameters=parameters))
    longer = "a free shaft that is 12 mm longer than logged"
    _, sure, _ = answer(spring)
    assert sure.endswith(f"; no reading of this log distinguishes it from {longer}.")
    assert alike(spring).startswith(f"Cannot be told from: {longer}. ")
    assert "longer" not in " ".join(answer(dry.found))


@pytest.mark.parametrize(
    ("verdict", "sure", "then"),
    [
        (
            {"kind": VerdictKind.NONE, "effects": ()},
            "Sure down to the detection limits: any of ",
            "Next: nothing has to change",
        ),
        (
            {"kind": VerdictKind.UNDECIDED, "confusable": ALIKE, "advice": "turn slowly"},
            "Sure that it is one of these, but not which one (probability of the first: 0.99",
            "Next: turn slowly.",
        ),
        (
            {"kind": VerdictKind.UNKNOWN, "effects": (), "advice": "look closer"},
            "The nearest explanation that was tried (dry (Coulomb) friction along the shaft) explains",
            "Next: look closer.",
        ),
    ],
)
def test_every_verdict_has_its_sentences(dry, verdict, sure, then):
    found = answer(concluding(dry.found, **verdict))
    assert found[1].startswith(sure)
    assert found[2].startswith(then)
    assert all(sentence.endswith(".") and ".." not in sentence for sentence in found)


@pytest.mark.parametrize("missing", [missing_with(), missing_with(law=None)])
def test_of_an_unknown_log_the_second_sentence_is_what_is_missing(dry, missing):
    found = replace(concluding(dry.found, kind=VerdictKind.UNKNOWN, effects=()), missing=missing)
    gap = found.assessment.gap
    assert answer(found)[1] == what_is_missing(missing, gap.before, gap.after)


def test_a_search_that_was_cut_short_is_not_sure(dry):
    found = replace(concluding(dry.found, kind=VerdictKind.UNDECIDED, confusable=ALIKE), stopped=STOPPED)
    what, sure, then = answer(found)
    assert what.startswith("Stopped early")
    assert sure.startswith(
        "Not sure, because what was not tried may explain the log as well; the best so"
    )
    assert (
        then == "Next: run the diagnosis to its end; it was stopped before the next step was determined."
    )


def test_one_trial_is_not_called_unseen(dry):
    alone = replace(dry.found, log=replace(dry.log, trials=dry.log.trials[:1]))
    assert "not seen" not in answer(alone)[1]
    assert "which is also the one that was fitted" in answer(alone)[1]


def test_without_limits_nothing_is_sure_and_without_an_effect_nothing_is_near(dry):
    told = replace(dry.found.assessment, detection_limits={})
    nothing = concluding(replace(dry.found, assessment=told), kind=VerdictKind.NONE, effects=())
    assert answer(nothing)[1] == "Detection limits were not computed."
    bare = replace(dry.found.assessment, nearest=replace(dry.found.assessment.nearest, effects=()))
    unknown = concluding(replace(dry.found, assessment=bare), kind=VerdictKind.UNKNOWN, effects=())
    assert answer(unknown)[1] == "Nothing that was tried improves on the nominal model."


def test_a_probability_is_never_one(dry):
    certain = concluding(dry.found, ranking=((("coulomb_friction",), 1.0),))
    assert answer(certain)[1].startswith(
        "Probability above 0.999 among all explanations that were tried;"
    )
