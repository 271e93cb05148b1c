"""Two parameters at once, where their region has a closed form."""

import numpy as np
import pytest
from diagnosis_fixtures import fit_of

from diagnosis.assessment.uncertainty.joint_uncertainty import joint_uncertainty
from diagnosis.effects import LIBRARY

TWO = ("tip_angle_bias", "tip_sensor_delay")
SCATTER = (LIBRARY["stiffness_error"], LIBRARY["damping_error"])


def joint(spread, names=TWO, **known):
    return joint_uncertainty(fit_of(names, **known), np.asarray(spread, float), names)


def test_every_point_of_the_outline_is_as_far_from_the_fit():
    """-2 log(0.05) = 5.99, which is exceeded by two normal numbers in 5 of 100 draws."""
    spread = np.array([[4.0, 1.5], [1.5, 1.0]])
    found = joint(spread, x=[2.0, 3.0])
    scales = np.array([p.scale for p in found.parameters])
    away = found.ellipse(0, 1) / scales[:, None] - np.array([[2.0], [3.0]])
    distance = np.einsum("in,ij,jn->n", away, np.linalg.inv(spread), away)
    np.testing.assert_allclose(distance, -2 * np.log(0.05), rtol=1e-9)
    draws = np.random.default_rng(2).multivariate_normal([0, 0], spread, size=20000)
    inside = np.einsum("ni,ij,nj->n", draws, np.linalg.inv(spread), draws) < distance[0]
    assert inside.mean() == pytest.approx(0.95, abs=4 * np.sqrt(0.95 * 0.05 / 20000))


@pytest.mark.filterwarnings("error")
def test_the_outline_of_what_the_data_leave_open_ends_at_the_bounds():
    found = joint(np.diag([9e4, 1e-4, 1e-4]), ("stiction",), x=[np.log(1e-3), np.log(1e-3), 0.0])
    level = found.parameters[0]
    outline = found.ellipse(0, 1)[0]
    assert (outline.min(), outline.max()) == pytest.approx((level.low, level.high))


def test_the_correlation_is_that_of_the_covariance_and_none_of_what_is_certain():
    assert joint([[4.0, 1.5], [1.5, 1.0]]).correlation(0, 1) == pytest.approx(0.75)
    assert joint([[0.0, 0.0], [0.0, 1.0]]).correlation(0, 1) == 0.0


def test_values_are_in_the_units_of_the_parameters():
    found = joint([[1.0]], ("coulomb_friction",), x=[np.log(0.002)])
    assert found.names == ("coulomb_friction.level",)
    assert found.values == pytest.approx([0.002])


def test_constants_of_the_rig_follow_the_effects_and_what_is_not_reported_is_left_out():
    fit = fit_of(("shear_thinning",), nuisance=SCATTER)
    found = joint_uncertainty(fit, np.diag([1.0, 2.0, 3.0, 4.0]), ("shear_thinning",))
    assert found.names == ("shear_thinning.exponent", "stiffness_error.scale", "damping_error.scale")
    np.testing.assert_array_equal(np.diag(found.covariance), [1.0, 3.0, 4.0])


def test_a_constant_that_is_named_is_there_once_and_first():
    fit = fit_of(("tip_drag",), nuisance=SCATTER)
    found = joint_uncertainty(fit, np.eye(3), ("damping_error", "tip_drag"))
    assert found.names == ("damping_error.scale", "tip_drag.damping", "stiffness_error.scale")


def test_the_covariance_of_values_is_that_of_what_draws_become():
    """Of a logarithm times the value; of others times the scale. For small spreads, draws agree."""
    spread = 1e-4 * np.array([[4.0, 1.5], [1.5, 1.0]])
    found = joint(spread, ("coulomb_friction", "tip_angle_bias"), x=[np.log(0.002), 3.0])
    scale = found.parameters[1].scale
    draws = np.random.default_rng(3).multivariate_normal([np.log(0.002), 3.0], spread, size=20000).T
    values = np.array([np.exp(draws[0]), scale * draws[1]])
    wanted = found.covariance_of_values
    assert wanted[0, 0] == pytest.approx(4e-4 * 0.002**2)
    # Four standard deviations of a covariance of 20000 draws, at most sqrt(2 / 20000) of it each.
    assert np.cov(values) == pytest.approx(wanted, rel=0.05)


def test_an_angle_is_told_in_the_half_periods_about_0():
    found = joint(np.eye(2), ("needle_curvature",), x=[np.log(0.001), 20.0])  # 200 deg
    assert found.values[1] == pytest.approx(200.0)
    assert found.told == pytest.approx([0.001, -160.0])
