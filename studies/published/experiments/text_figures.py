"""Figures that the paper's text gives in words ("about", "nearly").

No fit uses them: predictions are compared with them afterwards.
"""

from models import published
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
        value=published.FIG_3_PLASTISOL_LAG.value,
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
        value=published.FIG_5_SETTLING.value,
        unit="s",
        sigma=criteria.TEXT_SETTLING_SIGMA_S,
        sigma_source=_SIGMA_SOURCE,
    ),
    # "The tip eventually reaches the desired angle", having settled in nearly 2 s: nothing is left.
    MeasuredFigure(
        source="Fig. 5",
        experiment=TurnExperiment.QUICK_TURN,
        quantity=Quantity.ERROR_LEFT,
        depth_mm=200,
        value=0.0,
        unit="deg",
        sigma=criteria.TEXT_ERROR_LEFT_SIGMA_DEG,
        sigma_source="settled is within 3 deg",
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
