"""Estimates of the time that is left, from stages that are heard at given times."""

import pytest

from diagnosis.stages import ALIKE, STAGES
from diagnosis.time_left import TimeLeft

ORDER = list(STAGES)
SEARCH = ORDER[: ORDER.index("drift of the torque sensor")]
LEAST = {name: stage.least for name, stage in STAGES.items()}
MOST = {name: stage.most for name, stage in STAGES.items()} | {ALIKE: 0}  # as nothing explains the log


def heard(tasks, *, slower=1.0, compiling_s=0.0, estimates=None):
    """Estimates and end of a diagnosis whose stages have so many tasks, each of its usual time."""
    left, at_s, told = estimates or TimeLeft(), compiling_s, []
    left.heard("nominal replay", 0, 1, 0.0)
    for name, count in tasks:
        for done in range(count + 1):
            left.heard(name, done, count, at_s)
            told.append((at_s, name, left.between_s()))
            at_s += slower * STAGES[name].task_s * (done < count)
    return told, at_s


def tasks_of(counts, names=ORDER):
    return [(name, counts[name]) for name in names if counts[name]]


def at(told, stage):
    """The estimate where a stage begins."""
    return next((at_s, between) for at_s, name, between in told if name == stage)


@pytest.mark.parametrize("slower", [0.3, 1.0, 4.0])
@pytest.mark.parametrize("counts", [LEAST, MOST])
def test_the_truth_lies_between_the_estimates_at_any_pace(counts, slower):
    told, end_s = heard(tasks_of(counts), slower=slower)
    known = [(at_s, between) for at_s, _, between in told if between]
    assert len(known) > 0.9 * len(told)
    for at_s, (least_s, most_s) in known:
        assert least_s <= end_s - at_s + 1e-9
        assert most_s >= end_s - at_s - 1e-9


def test_too_little_done_says_nothing():
    told, _ = heard([("nominal rig", 1), ("screening single effects", 27)])
    assert told[0][2] is None
    assert told[-1][2] is not None


def test_once_an_effect_explains_the_log_one_estimate_is_left_and_it_is_true():
    told, end_s = heard(tasks_of(LEAST))
    at_s, (least_s, most_s) = at(told, "screening pairs")
    assert least_s == most_s == pytest.approx(end_s - at_s)


def test_most_falls_as_stages_are_skipped():
    names = [*tasks_of(MOST, SEARCH)]
    told, _ = heard([*names, ("held-out trials", 1), ("assessment", 1)])
    (_, (_, before_s)), (_, (_, after_s)) = (at(told, s) for s in ("screening pairs", "assessment"))
    assert after_s < 0.5 * before_s


def test_fits_to_the_whole_log_have_a_pace_of_their_own():
    """Where they are ten times as slow, screening does not seem so."""
    left = TimeLeft()
    left.heard("screening single effects", 0, 27, 0.0)
    left.heard("screening single effects", 27, 27, 1.62)
    left.heard("finalists", 0, 1, 1.62)
    before_s, _ = left.between_s()
    left.heard("finalists", 1, 1, 11.62)
    left.heard("screening pairs", 0, 27, 11.62)
    least_s, most_s = left.between_s()
    assert before_s - 2.0 < least_s == most_s < before_s


def test_a_compiler_that_the_first_replay_waits_for_says_nothing_of_the_pace():
    slow, fast = (heard(tasks_of(LEAST), compiling_s=s)[0] for s in (60.0, 0.0))
    assert at(slow, "finalists")[1] == pytest.approx(at(fast, "finalists")[1])


def test_a_stage_within_another_does_not_begin_that_again():
    told, _ = heard([*tasks_of(LEAST)])
    left = TimeLeft()
    heard([*tasks_of(LEAST)], estimates=left)
    left.heard("assessment", 1, 1, told[-1][0])
    assert left.between_s() == pytest.approx((0.0, 0.0))
