"""How the optimiser of a fit ended: its real messages, each provoked."""

import io

import numpy as np
import pytest
from mujoco import minimize

from diagnosis.fitting.fit_status import FitStatus, Termination


def said(residual, **options):
    """What MuJoCo's least squares print at their end."""
    printed = io.StringIO()
    bounds = [np.full(1, -10.0), np.full(1, 10.0)]
    final = {"verbose": minimize.Verbosity.FINAL, "output": printed}
    minimize.least_squares(np.array([2.0]), residual, bounds=bounds, **(final | options))
    return printed.getvalue()


def rosenbrock(x):
    """A valley that takes many steps."""
    return np.concatenate([1 - x, 10 * (x**2 - x)]).astype(float)


ENDS = {
    Termination.GRADIENT: {"gtol": 1e-3},
    Termination.STEP: {"gtol": 0.0, "xtol": 1e3},
    Termination.STALLED: {"jacobian": lambda x, r: np.array([[1.0], [-30.0]])},  # points uphill
    Termination.ITERATIONS: {"max_iter": 1, "gtol": 0.0, "xtol": 0.0},
    Termination.FACTORIZATION: {"jacobian": lambda x, r: np.full((2, 1), np.nan)},
}


@pytest.mark.parametrize("end", ENDS)
def test_the_optimisers_messages_are_understood(end):
    status = FitStatus.of_message(said(rosenbrock, **ENDS[end]))
    assert status.termination is end
    assert status.message.startswith("Terminated after ")
    assert "Residual evals" not in status.message
    assert status.converged is (end in (Termination.GRADIENT, Termination.STEP))


def test_every_message_of_the_optimiser_is_known():
    """An update of MuJoCo that adds or rewords one is noticed."""
    messages = [f"Terminated after 3 iterations: {m} y: 1" for m in minimize._STATUS_MESSAGE.values()]
    ends = {FitStatus.of_message(message).termination for message in messages}
    assert ends == set(ENDS)


def test_a_message_that_is_not_known_is_kept():
    status = FitStatus.of_message("something else", ("stiction.stribeck",))
    assert status.termination is Termination.OTHER
    assert status.message == "something else"
    assert status.at_bound == ("stiction.stribeck",)
    assert not status.converged
