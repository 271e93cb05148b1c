"""Figures that the paper's text gives in words ("about", "nearly").

They are no part of any fit: predictions are compared with them afterwards.
"""

from studies.published import criteria
from studies.published.experiments.measurement import MeasuredFigure, Quantity, TurnExperiment

_SIGMA_SOURCE = "as the words say"

TEXT_FIGURES_PLASTISOL = (
    # "The plastisols have a lag of about 10 deg".
    MeasuredFigure(
        source="Fig. 3",
        experiment=TurnExperiment.SLOW_TURN,
        quantity=Quantity.LAG,
        depth_mm=100,
        value=10.0,
        unit="deg",
        sigma=criteria.TEXT_LAG_SIGMA_DEG,
        sigma_source=_SIGMA_SOURCE,
    ),
    # "The settling time of nearly 2 s"; the depth is not said: the deepest of Fig. 5 is taken.
    MeasuredFigure(
        source="Fig. 5",
        experiment=TurnExperiment.QUICK_TURN,
        quantity=Quantity.SETTLING,
        depth_mm=200,
        value=2.0,
        unit="s",
        sigma=criteria.TEXT_SETTLING_SIGMA_S,
        sigma_source=_SIGMA_SOURCE,
    ),
)
TEXT_FIGURES_GELATIN = (
    # "Allows the needle to snap near to the final base angle": little of the lag is left.
    MeasuredFigure(
        source="Fig. 3",
        experiment=TurnExperiment.RELEASE,
        quantity=Quantity.LAG_LEFT,
        depth_mm=100,
        value=0.0,
        unit="-",
        sigma=criteria.TEXT_LAG_LEFT_SIGMA,
        sigma_source=_SIGMA_SOURCE,
    ),
)
