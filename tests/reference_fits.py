"""Fits to published figures without a simulation: a straight line, and fits with given residuals."""

import numpy as np

from diagnosis.effects.effect import Parameter
from diagnosis.replay.rig_parameters import RigParameters
from studies.published.experiments.figures import plastisol
from studies.published.experiments.measurement import MeasuredFigure, Quantity, TurnExperiment
from studies.published.experiments.rig import WITHOUT_FREE_LENGTH, PublishedRig
from studies.published.fitting.fit import FigureFit
from studies.published.fitting.fitter import FigureFitter
from studies.published.fitting.hypothesis import Hypothesis
from studies.published.fitting.mechanisms import DAMPING, Mechanism

SHARE = Parameter(name="p", unit="-", low=0.0, high=1.0, start=(0.5,))


class LineReplay:
    """Stands for the replay: every figure is its depth times the damping's scale."""

    def __call__(self, figures, rigs):
        return np.array([[f.depth_mm * rig.model.damping_scale for rig in rigs] for f in figures])


def line_figure(depth_mm, value, sigma, quantity=Quantity.DAMPING):
    return MeasuredFigure(
        source="line",
        experiment=TurnExperiment.SLOW_TURN,
        quantity=quantity,
        depth_mm=float(depth_mm),
        value=value,
        unit="-",
        sigma=sigma,
        sigma_source="",
    )


def line_figures(values, sigma):
    """Figures at depths 1, 2, ..."""
    return tuple(line_figure(i, value, sigma) for i, value in enumerate(values, start=1))


def damping_alone():
    return Hypothesis(names=(DAMPING.name,), base=PublishedRig(), mechanisms=(DAMPING,))


def fit_line(values, sigma):
    """The damping fitted to figures on a line."""
    return FigureFitter(line_figures(values, sigma), LineReplay()).fit(damping_alone())


def fit_with(names, z, *, base=WITHOUT_FREE_LENGTH, parameters=0, model=None):
    """A fit to plastisol with a residual of z standard deviations everywhere."""
    mechanism = Mechanism(
        name=names[0] if names else "none",
        place="-",
        parameters=(SHARE,) * parameters,
        apply=lambda rig, *p: PublishedRig(model=model or RigParameters()),
    )
    return FigureFit(
        hypothesis=Hypothesis(names=names, base=base, mechanisms=(mechanism,)),
        figures=plastisol(),
        x=np.zeros(parameters),
        residual=np.full(8, float(z)),
        jacobian=np.zeros((8, parameters)),
        left_out=np.full(8, float(z)),
    )


def as_published(rig, replay):
    """The figures that a rig would have had printed, with the standard deviations of the real ones."""
    values = replay(plastisol(), [rig])[:, 0]
    return tuple(
        MeasuredFigure(**{**vars(f), "value": float(v)})
        for f, v in zip(plastisol(), values, strict=True)
    )
