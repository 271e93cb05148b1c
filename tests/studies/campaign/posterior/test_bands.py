"""Bands of the tip error over time."""

import numpy as np
import pandas as pd
import pytest

from diagnosis.engines.local import on_this_machine
from sim.simulation import simulate
from studies.campaign.campaign import Campaign, read_campaign
from studies.campaign.posterior.bands import bands
from studies.campaign.posterior.drawn_rig import drawn_rig, tip_error_deg
from studies.campaign.results import ResultFolder
from studies.campaign.run import run_campaign
from studies.campaign.run_case import rows_of
from studies.campaign.summary import summarise, tip_error_bands


@pytest.fixture
def campaign(posterior_file):
    return read_campaign(posterior_file())


def rows(errors, status="done"):
    return pd.DataFrame(
        {"case": range(len(errors)), "status": status, "tip_error_deg": [list(e) for e in errors]}
    )


def test_bands_are_the_quantiles_of_the_rigs_at_each_time(campaign):
    errors = np.random.default_rng(1).normal(size=(21, 201)) + np.linspace(0, 5, 201)
    found = bands(campaign.posterior, campaign.base, errors)
    ordered = np.sort(errors, axis=0)
    for name, place in (("p5_deg", 1), ("p50_deg", 10), ("p95_deg", 19)):
        np.testing.assert_allclose(found[name], ordered[place])


def test_rigs_that_failed_are_not_in_the_bands(campaign):
    errors = np.random.default_rng(1).normal(size=(5, 201))
    both = pd.concat([rows(errors), rows(100 + errors, status="failed")])
    pd.testing.assert_frame_equal(
        tip_error_bands(campaign, both), bands(campaign.posterior, campaign.base, errors)
    )


def test_the_nominal_rig_and_the_most_probable_one_stand_beside(campaign):
    table = tip_error_bands(campaign, rows(np.zeros((1, 201))))
    assert table["base_angle_deg"].iloc[-1] == pytest.approx(60.0)
    assert list(table["time_s"].iloc[[0, -1]]) == [0.0, pytest.approx(0.3)]
    assert table["fit_deg"].iloc[-1] > table["nominal_deg"].iloc[-1] > 0  # dry friction beside viscous


def test_without_a_rig_that_could_be_simulated_there_is_no_band(campaign):
    found = tip_error_bands(campaign, rows(np.zeros((2, 201)), status="failed"))
    assert found["p50_deg"].isna().all()


def test_a_campaign_over_a_posterior_is_kept_and_goes_on(campaign, tmp_path):
    results = ResultFolder(folder=tmp_path / "out", campaign=campaign)
    run_campaign(results, on_this_machine(1), progress=lambda news: None)
    assert results.missing() == []
    table = results.read()
    levels = table["coulomb_friction.level"]
    # More dry friction, larger error: the rigs differ, and by what was drawn.
    last = table["tip_error_deg"].map(lambda errors: errors[-1])
    assert levels.nunique() == len(table) == 4
    assert np.corrcoef(levels.rank(), last.rank())[0, 1] > 0.5
    assert [path.name for path in summarise(results)][2:] == ["bands.csv", "bands.png"]
    kept = pd.read_csv(results.folder / "bands.csv")
    assert (kept["p5_deg"] <= kept["p50_deg"]).all()
    assert (kept["p50_deg"] <= kept["p95_deg"]).all()
    resolved = read_campaign(results.folder / "campaign.yaml")
    assert resolved.fingerprint == campaign.fingerprint


def test_the_width_is_that_of_the_covariance_through_the_slopes_of_the_tip(campaign):
    """Small spreads: 5 to 95 % are 2 * 1.645 sd, sd^2 = g C g, with slopes g by differences."""
    many = Campaign(**dict(campaign) | {"samples": 300})
    table = tip_error_bands(many, pd.DataFrame(rows_of(many, range(300))))
    known = many.posterior

    def end(values):
        drawn = drawn_rig(known, many.base, values)
        return tip_error_deg(drawn, simulate([drawn.setup()], drawn.schedule())[0])[-1]

    sd = np.sqrt(np.diag(known.matrix))
    steps = [known.fitted | {n: known.fitted[n] + s} for n, s in zip(known.parameters, sd, strict=True)]
    by_sd = [end(values) - end(known.fitted) for values in steps]
    width = float(table["p95_deg"].iloc[-1] - table["p5_deg"].iloc[-1])
    # A 5 % quantile of 300 draws is known to 0.12 sd, the width to 0.17 of 3.29: three times that.
    assert width == pytest.approx(2 * 1.645 * np.hypot(*by_sd), rel=3 * 0.17 / 3.29)
