"""Everything that a report is made of."""

from dataclasses import replace

from diagnosis.result import Diagnosis
from diagnosis.selection.record import failed
from diagnosis.workers import Failure


def with_failures(found, *failures):
    """The diagnosis as if these could not have been simulated."""
    record = (*found.record, *(e for stage, f in failures for e in failed(stage, [f])))
    return replace(found, record=record)


def test_what_could_not_be_simulated_is_a_warning_once_for_each_set_of_effects(dry):
    assert isinstance(dry.found, Diagnosis)
    assert dry.found.warnings == ()
    drag = Failure(effects=("tip_drag",), reason="lost its numbers")
    pair = Failure(effects=("tip_drag", "stiction"), reason="lost its numbers too")
    found = with_failures(dry.found, ("single effects", drag), ("finalists", drag), ("pairs", pair))
    assert found.warnings == (
        "tip_drag: not fully tried (finalists): lost its numbers",
        "tip_drag with stiction: not fully tried (pairs): lost its numbers too",
    )


def test_a_scatter_that_could_not_be_fitted_is_a_warning_on_the_nominal_rig(dry):
    found = with_failures(dry.found, ("nominal rig", Failure(effects=(), reason="lost its numbers")))
    assert found.warnings == ("the nominal rig: not fully tried (nominal rig): lost its numbers",)


def test_warnings_are_those_of_the_log_of_noise_of_the_search_and_of_the_replay(dry):
    found = replace(
        with_failures(dry.found, ("pairs", Failure(effects=("stiction",), reason="x"))),
        log=replace(dry.log, warnings=("log",)),
        noise=replace(dry.found.noise, warnings=("noise",)),
        assessment=replace(dry.found.assessment, warnings=("replay",)),
    )
    first, second, _, last = found.warnings
    assert (first, second, last) == ("log", "noise", "replay")


def test_a_notebook_shows_verdict_parameters_and_warnings_and_escapes_them(dry):
    shown = replace(dry.found, log=replace(dry.log, warnings=("<script>",)))._repr_html_()
    assert "explained coulomb_friction" in shown
    assert "<th>coulomb_friction level</th>" in shown
    assert "&lt;script&gt;" in shown
    assert "<script>" not in shown
