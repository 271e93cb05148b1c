"""What the figures support, in sentences."""

from dataclasses import replace

from studies.published.report.limitations import limitations
from studies.published.selection.verdict import VerdictKind


def test_limitations_state_what_is_computed_from_the_figures(study):
    said = "\n".join(limitations(study))
    # The numbers of docs/published-figures.md.
    assert "standard deviations of 30 % (50 mm free) or 14 % (no free length) or more" in said
    assert "0.34 ± 0.08 or 0.57 ± 0.13 of the stated one" in said
    assert "The best single mechanism is base_servo (no free length)" in said
    assert "were 5.6 %; 5 % is assumed" in said
    assert "is 6.4 for two parameters, 12 for three, 21 for four" in said
    assert "about 2 s in the paper's text; the stated model gives 5.17" in said


def test_equivalent_explanations_are_counted_only_where_there_are_several(study):
    assert not any("odds" in line for line in limitations(study))
    verdict = replace(study.plastisol.verdict, kind=VerdictKind.UNDECIDED)
    undecided = replace(study, plastisol=replace(study.plastisol, verdict=verdict))
    assert any("odds of the first to the next are 1.0 to 1" in line for line in limitations(undecided))
