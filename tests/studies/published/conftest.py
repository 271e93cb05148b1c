"""Fits and a study that several tests share, each made once."""

from types import SimpleNamespace

import pytest
from reference_fits import as_published

from diagnosis.replay.rig_parameters import RigParameters
from studies.published.compensator import CompensatorFigure
from studies.published.experiments.base_turn import BaseTurn, BaseTurnShape
from studies.published.experiments.replay import FigureReplay
from studies.published.experiments.rig import WITH_FREE_LENGTH, WITHOUT_FREE_LENGTH, PublishedRig
from studies.published.fitting.fitter import FigureFitter
from studies.published.fitting.hypothesis import of_gelatin, of_plastisol
from studies.published.fitting.insertion_hypotheses import ALL_INSERTION_HYPOTHESES
from studies.published.selection.hypothesis_set import HypothesisSet
from studies.published.study import run_published_study

COMPENSATOR = CompensatorFigure(
    name="Table IV, feedback, 5 cm",
    free_length="no free length",
    published=0.5,
    simulated=0.25,
    unit="s",
)
FEW_HYPOTHESES = HypothesisSet(
    plastisol=(of_plastisol(WITHOUT_FREE_LENGTH, "base_servo"),),
    pairs=lambda alone: [of_plastisol(WITHOUT_FREE_LENGTH, "base_servo", "shear_thinning")],
    gelatin=(of_gelatin("coulomb_friction"), of_gelatin("torque_bias")),
)
FEW_INSERTIONS = [
    h
    for h in ALL_INSERTION_HYPOTHESES
    if h.name in ("stated", "no friction at all", "larger damping") or "330 mm" in h.basis
]


@pytest.fixture(scope="session")
def progress():
    """What the study reported while it ran: what begins, share done."""
    return []


@pytest.fixture(scope="session")
def study(progress):
    """The study of the published figures with as few hypotheses as give two verdicts."""
    return run_published_study(
        lambda what, share: progress.append((what, share)),
        hypotheses=FEW_HYPOTHESES,
        insertions=FEW_INSERTIONS,
        compensator=lambda: (COMPENSATOR,),
    )


@pytest.fixture(scope="session")
def recovery():
    """A right and a wrong fit to figures of a rig with a servo and shared friction.

    The figures are from a finer needle, unrounded.
    """
    servo = BaseTurn(shape=BaseTurnShape.SERVO, time_s=0.11)
    truth = PublishedRig(model=RigParameters(shared_n_mm_per_mm=8e-4, damping_scale=0.4), turn=servo)
    replay = FigureReplay()
    fitter = FigureFitter(as_published(truth, FigureReplay(elements=8, refinement=2)), replay)
    right = of_plastisol(WITH_FREE_LENGTH, "base_servo", "speed_dependent_friction")
    wrong = of_plastisol(WITH_FREE_LENGTH, "tip_sensor_delay")
    return SimpleNamespace(truth=truth, replay=replay, right=fitter.fit(right), wrong=fitter.fit(wrong))
