"""The diagnosis on rigs that it has never met: a short run of `needle blind`.

The long run, of 210 logs, is in docs/accuracy.md; what follows from its table alone is tested in
`test_calibration`. It has 98 of 100 right; then seven logs have fewer than 6 right with a probability
of 0.8 % (binomial). With every other one right, 6 or more are with one of 6.3 %.
"""

from validation.score.calibration import coverage

LOGS = 7


def test_all_kinds_of_logs_are_diagnosed(scores):
    assert len(scores) == LOGS
    assert {*scores["kind"]} == {"none", "single", "pair", "off_nominal", "outside"}


def test_most_rigs_are_diagnosed_exactly(scores):
    wrong = scores[~scores["exact"]][["truth", "said", "verdict"]]
    assert scores["exact"].sum() >= 6, wrong


def test_no_alarm_is_false(scores):
    none = scores[scores["kind"] == "none"]
    assert len(none) >= 1
    assert (none["verdict"] == "none").all()


def test_a_wrong_explanation_is_rarely_stated_as_certain(scores):
    wrong = (scores["verdict"] == "explained") & ~scores["exact"]
    assert wrong.sum() <= 1, scores[wrong][["truth", "said"]]


def test_dry_friction_is_not_named_as_stiction_which_contains_it(scores):
    dry = scores[scores["truth"] == "coulomb_friction"]
    assert len(dry) >= 1
    assert not (dry["said"] == "stiction").any()


def test_intervals_contain_the_true_value(scores):
    """Of 7 intervals of 95 %, fewer than 5 do with a probability of 0.4 % (binomial)."""
    share, count = coverage(scores)
    assert count >= 7
    assert share >= 5 / 7
