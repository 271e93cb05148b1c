"""Probabilities of explanations, as bars."""

from dataclasses import replace

from diagnosis.report.figures.ranking import describe_ranking, draw_ranking
from diagnosis.report.sentences.names import explanations


def paired(found):
    """The same diagnosis, explained by a pair."""
    sets = ((("tip_drag", "torque_bias"), 0.9), (("stiction",), 0.1))
    return replace(found, verdict=replace(found.verdict, ranking=sets))


def test_a_pair_is_one_bar_at_its_probability(dry):
    axis = draw_ranking(paired(dry.found)).axes[0]
    assert [bar.get_width() for bar in axis.patches] == [0.9, 0.1]
    names = [label.get_text() for label in axis.get_yticklabels()]
    assert names == ["tip_drag + torque_bias", "stiction"]
    said = describe_ranking(paired(dry.found))
    assert said.endswith("each explanation: tip_drag + torque_bias 0.900, stiction 0.100.")


def test_bars_are_those_of_the_sentences(dry):
    widths = [bar.get_width() for bar in draw_ranking(dry.found).axes[0].patches]
    assert widths == [p for _, p in explanations(dry.found)[:6]]
