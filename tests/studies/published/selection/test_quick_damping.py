"""The damping of the quick turn from Table V alone."""

import pytest
from reference_fits import as_published

from diagnosis.replay.rig_parameters import RigParameters
from studies.published.experiments.base_turn import BaseTurn, BaseTurnShape
from studies.published.experiments.figures import plastisol
from studies.published.experiments.measurement import Quantity
from studies.published.experiments.replay import FigureReplay
from studies.published.experiments.rig import PublishedRig
from studies.published.selection.quick_damping import mean_delay_s, quick_damping


@pytest.mark.parametrize(
    "turn",
    [BaseTurn(time_s=0.1), BaseTurn(time_s=0.6), BaseTurn(shape=BaseTurnShape.SERVO, time_s=0.1)],
)
def test_the_difference_of_two_depths_in_table_v_does_not_depend_on_the_base(turn):
    """In viscous tissue it is the turn times the difference of the delays."""
    figures = [f for f in plastisol() if f.quantity is Quantity.INTEGRAL]
    shallow, deep = FigureReplay()(figures, [PublishedRig(free_mm=0.0, turn=turn)])[:, 0]
    expected = 90 * (mean_delay_s(100, 0) - mean_delay_s(50, 0))
    # The integral ends at 2 s: of the slowest mode exp(-8.2 (2 s - 1 s)) is left by then.
    assert deep - shallow == pytest.approx(expected, rel=2e-3)


def test_the_damping_that_table_v_shows_is_recovered():
    servo = BaseTurn(shape=BaseTurnShape.SERVO, time_s=0.11)
    rig = PublishedRig(model=RigParameters(damping_scale=0.6), free_mm=0.0, turn=servo)
    figures = as_published(rig, FigureReplay(elements=8, refinement=2))
    assert quick_damping(0.0, figures).ratio == pytest.approx(0.6, rel=5e-3)


def test_what_the_paper_prints_is_far_from_the_stated_damping():
    found = quick_damping(0.0)
    # By hand (37.2 - 27) / (90 x 0.2).
    assert found.ratio == pytest.approx(0.567, abs=1e-3)
    assert found.ratio + 3 * found.sigma < 1.0
