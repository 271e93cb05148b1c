"""How a fit ended: the real messages of the optimiser, each provoked, and ends on closed forms."""

import io
import re

import numpy as np
import pytest
from mujoco import minimize

from diagnosis.criteria.fitting import GAP_LIMIT
from diagnosis.criteria.selection import NEAR_FLOOR
from diagnosis.fitting.fit import _minimised
from diagnosis.fitting.fit_status import (
    _CREEPING,
    _FUTILE_LATER,
    _LITTLE,
    _SLOW,
    Ended,
    FitStatus,
    Stopping,
    Termination,
    far_for,
    in_words,
)


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
    assert re.fullmatch(
        r"(converged|ended|failed) after \d+ iterations?[,:] [a-z].*[a-z]", status.message
    )
    assert not any(word in status.message for word in ("tol", "norm", "Terminated", "evals"))
    assert status.converged is (end in (Termination.GRADIENT, Termination.STEP))


def test_every_message_of_the_optimiser_is_known():
    """An update of MuJoCo that adds or rewords one is noticed."""
    messages = [f"Terminated after 3 iterations: {m} y: 1" for m in minimize._STATUS_MESSAGE.values()]
    ends = {FitStatus.of_message(message).termination for message in messages}
    assert ends == set(ENDS)
    assert all("3 iterations" in FitStatus.of_message(message).message for message in messages)


def test_one_iteration_is_not_many():
    assert in_words(Termination.OFFSET, 1).startswith("converged after 1 iteration: ")


def test_a_message_that_is_not_known_is_kept():
    status = FitStatus.of_message("something else", ("stiction.stribeck",))
    assert status.termination is Termination.OTHER
    assert status.message == "something else"
    assert status.at_bound == ("stiction.stribeck",)
    assert not status.converged


class Line:
    """Residuals of a straight line through noise: y - (a + b t), of 200 samples."""

    difference = 1e-3

    def __init__(self):
        rng = np.random.default_rng(3)
        self.time = np.linspace(-1, 1, 200)
        self.read = 1.0 + 2.0 * self.time + rng.normal(size=200)
        self.low, self.high = np.full(2, -10.0), np.full(2, 10.0)
        self.slopes = -np.stack([np.ones(200), self.time], axis=-1)
        self.best = np.linalg.lstsq(-self.slopes, self.read, rcond=None)[0]

    def __call__(self, x):
        return self.read + self.slopes @ x.ravel()

    def jacobian(self, x, at_x):
        return self.slopes


def offset_by(objective, sigmas):
    """A vector so many of its own standard deviations from the minimum, in the first entry."""
    left = objective(objective.best)
    noise = np.sqrt(left @ left / 198)
    return objective.best + np.array([sigmas * noise / np.sqrt(200), 0.0])


def test_at_the_minimum_to_within_the_tolerance_it_has_converged():
    line = Line()
    # The offset is the root mean square over two parameters, of which one is off.
    x = offset_by(line, 0.09 * np.sqrt(2))
    with pytest.raises(Ended, match="converged after 0 iterations") as ended:
        Stopping(line, 0.1).jacobian(x, line(x))
    assert ended.value.termination is Termination.OFFSET
    np.testing.assert_array_equal(ended.value.x, x)


@pytest.mark.parametrize(
    ("sigmas", "step", "tries", "ends"),
    [
        (0.3, 1.0, 1, Termination.OFFSET),  # close: within five tolerances
        (0.7, 1.0, 8, Termination.STALLED),
        (0.7, 0.9e-5, 1, Termination.STALLED),  # a step that slopes over 0.001 say nothing of
        (0.7, 1.1e-5, 8, Termination.STALLED),
    ],
)
def test_a_search_along_a_direction_ends(sigmas, step, tries, ends):
    line = Line()
    stopping, x = Stopping(line, 0.1), offset_by(line, sigmas * np.sqrt(2))
    stopping.jacobian(x, line(x))
    for _ in range(tries):
        stopping(x + step)
    with pytest.raises(Ended) as ended:
        stopping(x + step)
    assert ended.value.termination is ends
    np.testing.assert_array_equal(ended.value.x, x)


def test_what_cannot_come_below_what_is_enough_is_behind_from_the_second_jacobian():
    line = Line()
    x = line.best + 0.1
    cost, least = float(line(x) @ line(x)), float(line(line.best) @ line(line.best))
    reach = cost - 10 * (cost - least)
    for enough, ends in ((reach - 1.0, True), (reach + 1.0, False)):
        stopping = Stopping(line, 1e-3, enough)
        stopping.jacobian(x, line(x))
        if ends:
            with pytest.raises(Ended, match="cannot come near"):
                stopping.jacobian(x, line(x))
        else:
            stopping.jacobian(x, line(x))


@pytest.mark.parametrize(("beyond", "ends"), [(-1.0, True), (1.0, False)])
def test_from_the_third_jacobian_on_less_is_hoped_for(beyond, ends):
    line = Line()
    x = line.best + 0.1
    cost, least = float(line(x) @ line(x)), float(line(line.best) @ line(line.best))
    stopping = Stopping(line, 1e-3, cost - _FUTILE_LATER * (cost - least) + beyond)
    for _ in range(2):
        stopping.jacobian(x, line(x))
    if ends:
        with pytest.raises(Ended, match="cannot come near"):
            stopping.jacobian(x, line(x))
    else:
        stopping.jacobian(x, line(x))


def test_what_bounds_forbid_is_not_promised():
    line = Line()
    line.low = line.best + 1.0
    x = line.low.copy()
    with pytest.raises(Ended) as ended:
        Stopping(line, 0.1).jacobian(x, line(x))
    assert ended.value.termination is Termination.OFFSET


class Bent(Line):
    """The same, with a third parameter that does nothing near its bound, and much elsewhere."""

    def __init__(self):
        super().__init__()
        self.low, self.high = np.full(3, -10.0), np.full(3, 10.0)
        left = self.read + self.slopes @ self.best
        self.slopes = np.column_stack([self.slopes, -1e-5 * np.sign(left)])

    def __call__(self, x):
        flat = x.ravel()
        rows = self.read + self.slopes[:, :2] @ flat[:2] - 100.0 * max(flat[2] + 9.0, 0.0)
        return rows.reshape(-1, *x.shape[1:])


def test_a_parameter_that_does_nothing_holds_up_no_other():
    """Its slope, 1e-5 of the noise, would send it across its range, whatever the others do."""
    objective = Bent()
    stopping = Stopping(objective, tolerance=0.01)
    found, status = _minimised(objective, np.array([5.0, 5.0, -10.0]), stopping, most_iterations=20)
    assert status.converged
    # A gradient of 0.02 sigma ends a fit; standard deviations are 1 / sqrt(200), and 1.7 times that.
    np.testing.assert_allclose(found[:2], objective.best, atol=0.02 * 2 / np.sqrt(200))
    assert found[2] == -10.0


class Bumpy(Line):
    """The same line through so much that no line can follow that the cost is `times` that of noise."""

    def __init__(self, times):
        super().__init__()
        steep = np.where(np.arange(200) % 2 == 0, 1.0, -1.0)
        self.read = 1.0 + 2.0 * self.time + np.sqrt(times) * steep
        self.best = np.linalg.lstsq(-self.slopes, self.read, rcond=None)[0]


def ended(stopping, objective, away):
    """How a fit ends that is so far from the best at one Jacobian after the other, and at which."""
    for taken, off in enumerate(away):
        x = objective.best + np.array([off, 0.0])
        try:
            stopping.jacobian(x, objective(x))
        except Ended as end:
            return end.termination, taken
    return None


def ends_at(objective, promised, far):
    """After how many Jacobians a fit ends that is promised such a share of what is beyond noise."""
    left = objective(objective.best)
    off = np.sqrt(promised * (left @ left - 200) / 200)
    return ended(Stopping(objective, 1e-3, far=far), objective, [off] * 3)


@pytest.mark.parametrize(
    ("times", "promised", "after"),
    [
        (1.05, 0.9 * _SLOW, (Termination.FAR, 1)),
        (1.05, 1.1 * _SLOW, None),  # such a step is worth taking
        (0.97, 0.9 * _SLOW, None),  # near the noise every bit tells
    ],
)
@pytest.mark.parametrize("leading", [True, False])
def test_far_above_the_noise_two_small_promises_in_turn_end_a_fit(leading, times, promised, after):
    far = far_for(leading=leading)
    assert ends_at(Bumpy(far * times), promised, far) == after


def test_a_fit_that_only_tells_which_to_do_again_ends_farther_above_the_noise():
    assert far_for(leading=True) == NEAR_FLOOR
    assert far_for(leading=False) == GAP_LIMIT**2  # what is at the floor goes on to its end


def test_without_a_limit_a_fit_goes_on_wherever_it_is():
    assert ends_at(Bumpy(9.0 * NEAR_FLOOR), 0.9 * _SLOW, np.inf) is None


def test_a_fit_that_has_converged_is_not_said_to_be_slow():
    bumpy = Bumpy(2 * NEAR_FLOOR)
    left = bumpy(bumpy.best)
    stopping = Stopping(bumpy, 0.1, far=NEAR_FLOOR)
    x = bumpy.best + np.array([np.sqrt(0.9 * _SLOW * (left @ left - 200) / 200), 0.0])
    stopping.jacobian(x, bumpy(x))
    with pytest.raises(Ended) as ended:
        stopping.jacobian(bumpy.best, left)
    assert ended.value.termination is Termination.OFFSET


@pytest.mark.parametrize("end", Termination)
def test_what_was_given_up_has_not_the_values_of_the_minimum(end):
    status = FitStatus(termination=end, message="")
    assert status.ended_early is (end in (Termination.FAR, Termination.BEHIND))
    assert not (status.ended_early and status.converged)


def test_one_small_promise_ends_no_fit():
    bumpy = Bumpy(2 * NEAR_FLOOR)
    left = bumpy(bumpy.best)
    excess = left @ left - 200
    promised = (0.9 * _SLOW, 1.1 * _SLOW, 0.9 * _SLOW)
    away = [np.sqrt(share * excess / 200) for share in promised]
    assert ended(Stopping(bumpy, 1e-3, far=NEAR_FLOOR), bumpy, away) is None
    assert ended(Stopping(bumpy, 1e-3, far=NEAR_FLOOR), bumpy, [away[0]] * 3) is not None


def ends_where_steps_take(share, promised, times=1.0, far=NEAR_FLOOR):
    """After how many Jacobians a fit ends whose steps take off such a share of what is promised.

    Args:
      promised: by the first Jacobian, in cost.
      times: cost of what no line can follow / that of noise.
    """
    bumpy = Bumpy(times)
    away = np.sqrt(promised * (1 - share) ** np.arange(5) / 200)
    return ended(Stopping(bumpy, 1e-3, far=far), bumpy, away)


@pytest.mark.parametrize(
    ("share", "promised", "times", "after"),
    [
        (0.8 * _CREEPING, 0.9 * _LITTLE, 1.0, (Termination.CREEPING, 2)),
        (1.2 * _CREEPING, 0.9 * _LITTLE, 1.0, None),  # steps that keep what they promise go on
        (0.8 * _CREEPING, 4.0 * _LITTLE, 1.0, None),  # so does what may decide something
        (0.8 * _CREEPING, 0.9 * _LITTLE, 1.1 * GAP_LIMIT**2, None),  # and what is above the noise
    ],
)
def test_at_the_noise_a_fit_that_creeps_ends(share, promised, times, after):
    assert ends_where_steps_take(share, promised, times) == after


def test_a_fit_that_goes_to_its_end_may_creep():
    assert ends_where_steps_take(0.8 * _CREEPING, 0.9 * _LITTLE, far=np.inf) is None
