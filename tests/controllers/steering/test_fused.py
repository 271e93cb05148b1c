"""The fused estimator: consistent with its own noise, and right where the base alone is wrong."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.stats import chi2

from controllers.estimators import FeedforwardEstimator
from controllers.signals import Sample, Status
from controllers.steering.fused import FusedEstimator, FusionNoise
from controllers.steering.tip_pose import TipPose
from models.bevel import BevelTip
from models.errors import InvalidValue
from models.needle import NITINOL

RADIUS_MM, DAMPING, SPEED_MM_S, START_MM, STEP_S, DURATION_S = 61.0, 0.01725, 5.0, 40.0, 0.02, 8.0
ALL_MM = 180.0
RAD = math.pi / 180
NOISE = FusionNoise()
IMAGE_EVERY = 7  # samples
MODES, ODD, SIGN = np.arange(1, 4), np.array([1, 0, 1]), np.array([-1, 1, -1])


def fused(noise=NOISE, start_mm=(0, 0, 0)):
    return FusedEstimator(
        NITINOL, damping_n_mm_s_per_mm=DAMPING, radius_mm=RADIUS_MM, noise=noise, start_mm=start_mm
    )


def torque(t):
    return 2.0 * np.sin(0.9 * t) + np.cos(2.3 * t)


def depth(t):
    return START_MM + SPEED_MM_S * t


def true_modes(times):
    """p_1 .. p_3 of a shaft that goes in, by scipy: the equations of controllers.twist, written out."""
    k, j = MODES[:, None], MODES[None, :]
    with np.errstate(divide="ignore", invalid="ignore"):
        apart = 2 * j**2 / (k**2 - j**2) * (-1.0) ** (k + j)
    stretch = np.where(k == j, -0.5, apart)

    def rate(t, p):
        inserted = depth(t)
        decay = NITINOL.rigidity_n_mm2 / (DAMPING * inserted**2) * (MODES * np.pi) ** 2
        stretching = SPEED_MM_S / inserted * (stretch @ p)
        return -decay * p + SIGN * 2 * torque(t) / (inserted * DAMPING) - stretching

    span = (times[0], times[-1])
    solved = solve_ivp(rate, span, np.zeros(3), t_eval=times, method="BDF", rtol=1e-8, atol=1e-10)
    return solved.y.T


class Truth:
    """A needle that is as the filter assumes, with errors drawn from what it assumes."""

    times = np.arange(0, DURATION_S, STEP_S)
    modes = true_modes(times)

    def __init__(self, seed, noise=NOISE):
        self.rng, self.noise = np.random.default_rng(seed), noise
        n = self.times.size
        self.bias = noise.torque_bias_n_mm * self.rng.normal()
        drift = noise.lag_drift_deg * math.sqrt(STEP_S) * self.rng.normal(size=n)
        self.lag = RAD * (noise.lag_deg * self.rng.normal() + np.cumsum(drift))
        kappa = NITINOL.rigidity_n_mm2
        tail = (
            -4 * depth(self.times) * torque(self.times) * (np.pi**2 / 8 - 1 - 1 / 9) / (kappa * np.pi**2)
        )
        twist = -torque(self.times) * (ALL_MM - depth(self.times)) / kappa + tail + 2 * self.modes @ ODD
        self.base = 1.5 * np.sin(1.3 * self.times)
        self.roll = self.base + twist + self.lag
        self.pose = TipPose(RADIUS_MM)
        self.pose.correct(
            noise.start_mm * self.rng.normal(size=3),
            noise.start_direction_deg * RAD * self.rng.normal(size=3),
        )

    def sample(self, i):
        u = torque(self.times[i]) + self.bias + self.noise.torque_n_mm * self.rng.normal()
        inserted = depth(self.times[i])
        return Sample(self.times[i], self.base[i] / RAD, u, inserted, ALL_MM - inserted)

    def advance(self, i):
        if i:
            travel = SPEED_MM_S * STEP_S
            self.pose.advance(travel, 0.5 * (self.roll[i] + self.roll[i - 1]))
            bend = self.noise.direction_drift_deg * RAD * math.sqrt(travel)
            self.pose.correct(np.zeros(3), bend * self.rng.normal(size=3))

    def image(self, position):
        return position + self.noise.image_mm * self.rng.normal(size=3)


def followed(seed, *, noise=NOISE, assumed=None, late=4):
    """A filter that followed a truth with images that arrive `late` samples after exposure."""
    truth, one, exposed = Truth(seed, noise), fused(assumed or noise), None
    for i in range(truth.times.size):
        truth.advance(i)
        one.update(truth.sample(i))
        if i % IMAGE_EVERY == late and exposed is not None:
            one.see(truth.image(exposed))
        if i % IMAGE_EVERY == 0:
            one.expose()
            exposed = truth.pose.position_mm.copy()
    return truth, one


def normalised_error(truth, one):
    """e' P^-1 e of pose, modes, bias and lag: eleven of them."""
    position, direction = one.pose.errors_to(truth.pose.position_mm, truth.pose.frame)
    modes = truth.modes[-1] - one._p
    rest = [truth.bias - one.bias_n_mm, truth.lag[-1] - one.lag_rad]
    error = np.concatenate([position, direction, modes, rest])
    return float(error @ np.linalg.solve(one.covariance[:11, :11], error)), error


def mean_nees(seeds, assumed=NOISE):
    """Mean of e' P^-1 e over seeds, and the bounds of chi-square that hold in 99.9 % of trials."""
    found = [normalised_error(*followed(seed, assumed=assumed))[0] for seed in range(seeds)]
    low, high = chi2.ppf([0.0005, 0.9995], seeds * 11) / seeds
    return float(np.mean(found)), low, high


@pytest.mark.slow
def test_its_errors_are_as_large_as_its_covariance_says():
    found, low, high = mean_nees(30)
    assert low < found < high


@pytest.mark.parametrize(
    "wrong", [{"image_mm": 0.2}, {"torque_bias_n_mm": 0.05}, {"lag_drift_deg": 0.2}]
)
def test_a_filter_that_assumes_too_little_noise_is_found_out(wrong):
    """Negative control of the test above."""
    found, _, high = mean_nees(8, NOISE.but(**wrong))
    assert found > high


@pytest.mark.slow
def test_images_tell_most_of_what_the_base_does_not_know():
    """A bias of 0.3 N mm and a constant lag put the roll off by 7 deg in the mean."""
    constant, fused_wrong, base_wrong = NOISE.but(lag_drift_deg=0.0), [], []
    for seed in range(10):
        truth, one = followed(seed, noise=constant)
        fused_wrong.append(one._estimate.tip_deg - truth.roll[-1] / RAD)
        base = FeedforwardEstimator(NITINOL, damping_n_mm_s_per_mm=DAMPING)
        replay = Truth(seed, constant)
        for i in range(replay.times.size):
            estimate = base.update(replay.sample(i))
        base_wrong.append(estimate.tip_deg - truth.roll[-1] / RAD)
    assert np.square(fused_wrong).mean() < 0.25 * np.square(base_wrong).mean()


@pytest.mark.parametrize("index", range(6, 12))
def test_the_transition_is_the_derivative_of_a_step(index):
    """Finite differences for an error of each mode, bias, lag and torque noise before the step."""
    truth, small = Truth(3), 1e-5
    samples = truth.sample(50), truth.sample(51)

    def stepped(error):
        one = fused()
        one.update(samples[0])
        one._inject(error)
        one.update(samples[1])
        return one

    nominal, moved = stepped(np.zeros(15)), stepped(small * np.eye(15)[index])
    position, direction = nominal.pose.errors_to(moved.pose.position_mm, moved.pose.frame)
    rest = [
        *(moved._p - nominal._p),
        moved.bias_n_mm - nominal.bias_n_mm,
        moved.lag_rad - nominal.lag_rad,
    ]
    change = np.concatenate([position, direction, rest]) / small
    # A travel of 0.1 mm turns by 0.0016 rad: its square is left out.
    assert change == pytest.approx(nominal.transition[:11, index], abs=1e-5)


def test_without_doubt_it_is_the_feedforward_estimator_whatever_the_images_say():
    trusting = NOISE.but(torque_bias_n_mm=0.0, lag_deg=0.0, lag_drift_deg=0.0, torque_n_mm=0.0)
    truth, one = Truth(1), fused(trusting)
    base = FeedforwardEstimator(NITINOL, damping_n_mm_s_per_mm=DAMPING)
    for i in range(100):
        sample = truth.sample(i)
        assert one.update(sample).tip_deg == pytest.approx(base.update(sample).tip_deg, abs=1e-9)
        one.expose()
        one.see(np.array([0.0, 30.0, -20.0]))


def test_a_late_image_is_compared_with_the_place_of_its_exposure():
    """Two filters, one whose images come at once: without noise in between they end alike."""
    still = NOISE.but(torque_n_mm=0.0, lag_drift_deg=0.0, direction_drift_deg=0.0)
    truth = Truth(2, still)
    samples = [truth.sample(i) for i in range(60)]
    place = np.array([1.0, 0.3, -0.2])
    ends = []
    for arrival in (20, 26):
        one = fused(still)
        for i, sample in enumerate(samples):
            one.update(sample)
            if i == 20:
                one.expose()
            if i == arrival:
                one.see(place)
        ends.append(one)
    at_once, late = ends
    # The correction of a roll is carried on to first order: 0.02 rad squared over 60 samples.
    assert late.lag_rad == pytest.approx(at_once.lag_rad, abs=1e-4)
    assert late.pose.position_mm == pytest.approx(at_once.pose.position_mm, abs=1e-3)
    assert np.diag(late.covariance)[:11] == pytest.approx(np.diag(at_once.covariance)[:11], rel=0.02)


def test_an_image_that_is_not_finite_or_was_not_taken_changes_nothing():
    one, truth = fused(), Truth(1)
    one.update(truth.sample(0))
    assert one.see(np.zeros(3)) == 0.0
    one.expose()
    before = one.covariance.copy()
    assert one.see(np.array([0.0, math.nan, 0.0])) == 0.0
    assert np.array_equal(one.covariance, before)


def test_outside_the_tissue_the_tip_is_where_the_base_is_and_the_pose_goes_on():
    one = fused()
    outside = Sample(0.0, 30.0, 0.4, 0.0, 150.0)
    one.update(outside)
    estimate = one.update(replace(outside, time_s=0.1, inserted_mm=0.5, free_mm=149.5))
    assert (estimate.status, estimate.tip_deg) == (Status.OUTSIDE, 30.0)
    arc = BevelTip(RADIUS_MM)
    arc.advance(0.5, 30.0 * RAD)
    assert one.pose.position_mm == pytest.approx(arc.position_mm)
    assert one.tip_spread_deg == 0.0


def test_a_bad_sample_moves_nothing():
    one, truth = fused(), Truth(1)
    one.update(truth.sample(0))
    held = one.update(replace(truth.sample(1), torque_n_mm=math.nan))
    assert held.status is Status.BAD_SAMPLE
    assert one.pose.position_mm == pytest.approx(np.zeros(3))


def test_an_impossible_radius_or_noise_is_refused_by_name():
    with pytest.raises(InvalidValue, match="radius_mm"):
        FusedEstimator(NITINOL, damping_n_mm_s_per_mm=DAMPING, radius_mm=0.0)
    with pytest.raises(InvalidValue, match="image_mm"):
        FusionNoise(image_mm=0.0)
