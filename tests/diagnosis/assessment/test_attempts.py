"""What is told beside a verdict, where it cannot be simulated."""

from diagnosis.assessment.attempts import Attempts
from sim.needles.run import SimulationFailed


def failing():
    raise SimulationFailed("lost its numbers")


def test_what_works_is_told_without_a_warning():
    tried = Attempts()
    assert tried.or_else("limits", lambda: 3, 0) == 3
    assert tried.warnings == []


def test_what_cannot_be_simulated_is_replaced_and_each_loss_is_told():
    tried = Attempts()
    assert tried.or_else("limits", failing, 0) == 0
    assert tried.or_else("order", failing, "as found") == "as found"
    assert tried.warnings == [
        "limits: could not be simulated (lost its numbers)",
        "order: could not be simulated (lost its numbers)",
    ]
