"""Table and picture of a campaign."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest

from studies.campaign import summary
from studies.campaign.campaign import read_campaign
from studies.campaign.results import ResultFolder
from studies.campaign.summary import numeric_varied, summarise, summary_table


def table(**columns):
    rows = pd.DataFrame({"case": range(11), "status": "done", "error": None})
    return rows.assign(
        inserted_mm=np.linspace(80, 120, 11),
        largest_lag_deg=np.linspace(0, 10, 11) ** 2,
        largest_lag_time_s=1.3,
        end_lag_deg=0.5,
        largest_base_torque_n_mm=np.linspace(1, 0, 11),
        end_tip_deg=60.0,
        unconverged_count=0,
        **columns,
    )


@pytest.fixture
def results(campaign_file, tmp_path):
    vary = {"inserted_mm": {"uniform": [80, 120]}}
    return ResultFolder(folder=tmp_path, campaign=read_campaign(campaign_file(vary=vary)))


def test_figures_are_those_of_the_cases_that_were_done(results):
    rows = table()
    rows.loc[0, "status"] = "failed"
    found = summary_table(results, rows).loc["largest_lag_deg"]
    squares = np.arange(1, 11) ** 2
    assert found["cases"] == 10
    assert found["mean"] == squares.mean()
    assert found["sd"] == pytest.approx(squares.std(ddof=1))
    assert (found["min"], found["median"], found["max"]) == (1, 30.5, 100)
    assert found["p97.5"] == pytest.approx(np.quantile(squares, 0.975))


def test_rank_correlations_say_what_grows_with_what(results):
    correlation = summary_table(results, table())["rank correlation with inserted_mm"]
    assert correlation["largest_lag_deg"] == pytest.approx(1)
    assert correlation["largest_base_torque_n_mm"] == pytest.approx(-1)
    assert np.isnan(correlation["end_lag_deg"])  # it does not vary


def test_names_have_no_rank(campaign_file, tmp_path):
    vary = {"tissue": {"choice": ["chicken", "simtest"]}, "free_mm": {"uniform": [1, 2]}}
    results = ResultFolder(folder=tmp_path, campaign=read_campaign(campaign_file(vary=vary)))
    rows = table(tissue="chicken", free_mm=1.5)
    assert numeric_varied(results, rows) == ["free_mm"]


@pytest.fixture
def drawn(results):
    """The figure of a summary, closed after the test."""

    def draw(rows, results=results):
        with pytest.MonkeyPatch.context() as patch:
            figures = []
            patch.setattr(plt, "close", figures.append)
            summary.draw(results, rows, results.folder / "summary.png")
        return figures[0]

    yield draw
    plt.close("all")


def test_the_picture_has_a_panel_for_each_result_that_differs(drawn):
    panels = drawn(table()).axes
    assert [p.get_ylabel() for p in panels[::2]] == ["largest_lag_deg"]
    np.testing.assert_array_equal(panels[0].lines[0].get_ydata(), np.linspace(0, 10, 11) ** 2)


def test_names_are_literal_text(campaign_file, tmp_path, drawn):
    path = campaign_file(name="$\\frac{a$ $", vary={"inserted_mm": {"uniform": [80, 120]}})
    results = ResultFolder(folder=tmp_path, campaign=read_campaign(path))
    title = drawn(table(), results).get_suptitle()
    assert title == "$\\frac{a$ $: 11 cases, 0 failed"


def test_few_values_are_joined_by_their_medians(drawn):
    rows = table()
    rows["inserted_mm"] = [80.0, 100.0] * 5 + [120.0]
    line = drawn(rows).axes[0].lines[1]
    np.testing.assert_array_equal(line.get_xdata(), [80, 100, 120])
    assert line.get_ydata()[0] == 16.0  # of 0, 4, 16, 36, 64


@pytest.mark.parametrize("failed", [False, True])
def test_table_and_picture_are_written_even_if_every_case_failed(results, failed):
    results.begin(force=True)
    for piece in results.missing():
        rows = table(seed=0).to_dict("records")
        keep = [rows[case % 11] | {"case": case} for case in piece]
        if failed:
            keep = [{"case": case, "status": "failed", "error": "why"} for case in piece]
        results.write(piece, keep)
    for path in summarise(results):
        assert path.stat().st_size > 100
