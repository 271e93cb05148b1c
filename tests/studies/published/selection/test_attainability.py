"""Which figures a mechanism cannot explain."""

from dataclasses import replace

from reference_fits import LineReplay, damping_alone, line_figure, line_figures

from studies.published.experiments.measurement import Quantity
from studies.published.fitting.fitter import FigureFitter
from studies.published.selection.attainability import unattainable
from studies.published.selection.verdict import unresolved

TABLE_II = line_figures([1.0, 2.0, 3.0], 0.01)
# What Table II says of the quick turn, and what it contradicts.
RIGHT = line_figure(5, 5.0, 0.1, Quantity.INTEGRAL)
FAR = line_figure(5, 50.0, 0.1, Quantity.SETTLING)


def fit_to(*figures):
    return FigureFitter((*TABLE_II, *figures), LineReplay()).fit(damping_alone())


def test_a_figure_is_unattainable_if_it_contradicts_table_ii_for_any_parameters():
    fit = fit_to(RIGHT, FAR)
    # The compromise between all figures leaves both unresolved; Table II allows one of them.
    assert {RIGHT, FAR} <= set(unresolved(fit))
    assert unattainable(fit, LineReplay()) == (FAR,)


def test_what_a_special_case_explains_the_richer_mechanism_explains_too():
    fit = fit_to(FAR)
    (mechanism,) = fit.hypothesis.mechanisms
    richer = replace(
        fit.hypothesis, names=("richer",), mechanisms=(replace(mechanism, contains=("special",)),)
    )
    special = replace(fit.hypothesis, names=("special",))
    fit = replace(fit, hypothesis=richer)
    assert unattainable(fit, LineReplay(), {special: (FAR,)}) == (FAR,)
    assert unattainable(fit, LineReplay(), {special: ()}) == ()


def test_no_delay_of_the_sensor_explains_how_soon_the_published_needle_is_there(recovery):
    # The stated damping with 50 mm free is slower than the rig, and a delay makes it no quicker.
    wrong, kept = recovery.wrong, [0, 1, 2, 3, 7]
    figures = tuple(wrong.figures[i] for i in kept)
    (found,) = unattainable(
        replace(wrong, figures=figures, residual=wrong.residual[kept]), recovery.replay
    )
    assert found.name == "Table V, integral, 10 cm"
