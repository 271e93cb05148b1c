"""The verdict and the next experiment in words."""

from dataclasses import replace

from studies.published.report.sentences import next_experiment, verdict_sentence
from studies.published.selection.verdict import VerdictKind


def with_kind(material, kind):
    return replace(material, verdict=replace(material.verdict, kind=kind))


def test_the_verdict_says_what_explains_the_figures_and_how_much(study):
    assert verdict_sentence(study.plastisol) == (
        "Explained: base_servo and shear_thinning explains the 8 figures of plastisol, rms residual "
        "7.5 σ (50 mm free) or 3.5 σ (no free length) → 0.8 σ."
    )


def test_every_kind_of_verdict_is_said_first(study):
    for kind in VerdictKind:
        said = verdict_sentence(with_kind(study.plastisol, kind))
        assert said.lower().startswith(f"{kind.value}: ")


def test_an_undecided_verdict_names_what_is_equivalent(study):
    said = verdict_sentence(with_kind(study.gelatin, VerdictKind.UNDECIDED))
    assert "1 explanations of the 4 figures of gelatin are equivalent (coulomb_friction)" in said


def test_a_next_experiment_is_proposed_if_and_only_if_explanations_are_left(study):
    assert next_experiment(study) == ""
    undecided = replace(study, plastisol=with_kind(study.plastisol, VerdictKind.UNDECIDED))
    said = next_experiment(undecided)
    assert said.startswith("Record the base angle of the quick turn")
    assert study.proposed[0].measurement.experiment.value in said
