"""Rigs that are drawn from what a diagnosis knows: their covariance, their bounds, their effects."""

import json

import numpy as np
import pytest
from campaigns import posterior

from models.errors import InvalidValue
from studies.campaign.posterior.rig_posterior import RigPosterior, read_posterior

SPREAD = [[0.0625e-6, -0.02e-3], [-0.02e-3, 0.01]]


def draws(one, count=4000):
    rng = np.random.default_rng(3)
    return np.array([list(one.drawn(rng).values()) for _ in range(count)])


def test_draws_have_the_covariance_in_the_units_that_the_fit_moved_in():
    """The level is fitted in its logarithm, which has C / (value value); the scale is not."""
    one = RigPosterior(**posterior(matrix=SPREAD))
    level, scale = draws(one).T
    found = np.cov(np.log(level), scale)
    wanted = np.array(SPREAD) / np.outer([0.0015, 1.0], [0.0015, 1.0])
    # Four standard deviations of a covariance of 4000 draws.
    slack = 4 * np.sqrt((wanted**2 + np.outer(np.diag(wanted), np.diag(wanted))) / 4000)
    assert (np.abs(found - wanted) < slack).all()
    assert np.corrcoef(np.log(level), scale)[0, 1] < -0.7  # -0.8


def test_draws_stay_within_the_bounds_of_the_fit():
    one = RigPosterior(**posterior(bounds=[[1e-6, 0.0015], [0.9, 3.0]], matrix=SPREAD))
    level, scale = draws(one, 400).T
    assert level.max() <= 0.0015
    assert scale.min() >= 0.9
    assert scale.min() < 0.95  # and the bound cuts draws that were there


def test_bounds_that_no_draw_keeps_are_an_error():
    one = RigPosterior(**posterior(bounds=[[0.04, 0.05], [0.3, 3.0]], matrix=SPREAD))
    with pytest.raises(InvalidValue, match="bounds"):
        one.drawn(np.random.default_rng(0))


def test_what_is_certain_does_not_vary():
    one = RigPosterior(**posterior(matrix=[[0.0, 0.0], [0.0, 0.01]]))
    assert set(draws(one, 20)[:, 0]) == {0.0015}


def test_the_rig_has_the_effects_of_its_parameters():
    rig = RigPosterior(**posterior()).rig_with(
        {"coulomb_friction.level": 2e-3, "stiffness_error.scale": 0.9}
    )
    assert (rig.kinetic_n_mm_per_mm, rig.stiffness_scale, rig.damping_scale) == (2e-3, 0.9, 1.0)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"parameters": ["coulomb_friction.levle", "stiffness_error.scale"]}, "levle"),
        ({"parameters": [], "values": [], "bounds": [], "matrix": []}, "at least one"),
        ({"values": [0.0015]}, "for 2 parameters"),
        ({"values": [-0.0015, 1.0]}, "coulomb_friction.level above 0"),
        ({"matrix": [[1e-8, 1e-3], [0.0, 0.01]]}, "symmetric"),
        ({"matrix": [[-1e-8, 0.0], [0.0, 0.01]]}, "symmetric"),
    ],
)
def test_a_covariance_that_is_none_is_refused(changes, said):
    with pytest.raises(InvalidValue, match=said):
        RigPosterior(**posterior(**changes))


def test_a_report_is_read_and_one_without_covariance_says_what_to_do(tmp_path):
    path, content = tmp_path / "report.json", posterior()
    path.write_text(
        json.dumps({"rig": content.pop("rig"), "covariance": content, "verdict": "explained"})
    )
    assert read_posterior(path) == RigPosterior(**posterior())
    report = {"covariance": content, "rig": posterior()["rig"], "fit": {"presliding_deg": 0.12}}
    path.write_text(json.dumps(report))
    assert read_posterior(path).rig_with({"coulomb_friction.level": 2e-3}).presliding_deg == 0.12
    path.write_text('{"verdict": "explained"}')
    with pytest.raises(InvalidValue, match="diagnose the log again"):
        read_posterior(path)
    path.write_text("[")
    with pytest.raises(InvalidValue, match="report.json of a diagnosis"):
        read_posterior(path)
