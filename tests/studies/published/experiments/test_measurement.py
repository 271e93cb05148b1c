"""Names of measurements."""

from studies.published.experiments.measurement import MeasuredFigure, Quantity, TurnExperiment


def test_a_figure_is_named_by_source_quantity_and_depth_in_cm():
    figure = MeasuredFigure(
        source="Table II",
        experiment=TurnExperiment.SLOW_TURN,
        quantity=Quantity.DAMPING,
        depth_mm=25.0,
        value=0.37,
        unit="N mm s",
        sigma=0.1,
        sigma_source="-",
    )
    assert figure.name == "Table II, damping, 2.5 cm"
