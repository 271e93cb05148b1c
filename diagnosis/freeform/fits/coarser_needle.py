"""The decimated log for first fits, which only tell what is worth more: for a needle half as fine.

Its readings are moved by what that needle reads otherwise for the rig without a law,

    read, rough = read + (predicted by the rough needle - predicted),

so that this rig leaves the same residuals, and every law changes them by what it changes of the rough
needle: a quarter of the cost.
"""

from dataclasses import replace

from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.replay import replay


def on_coarser_needle(coarse: FitProblem, base: Fit) -> FitProblem:
    """The problem for a needle half as fine, of which the rig of a fit leaves the same.

    Raises:
      SimulationFailed: this needle cannot be simulated.
    """
    rough = coarse.of_differences
    rig = base.parameterization.rig(base.x)
    here, there = (replay(p.log, rig, p.resolution) for p in (coarse, rough))
    each = zip(coarse.log.trials, here, there, strict=True)
    log = replace(coarse.log, trials=tuple(_moved(*one) for one in each))
    return replace(rough, log=log, differences_halved=False)


def _moved(trial: PreparedTrial, here: Prediction, there: Prediction) -> PreparedTrial:
    readings = {s: read + (there[s] - here[s]) for s, read in trial.readings.items()}
    return replace(trial, readings=readings)
