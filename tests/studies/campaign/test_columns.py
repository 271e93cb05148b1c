"""Columns of the results and their types."""

import pytest

from studies.campaign.campaign import read_campaign
from studies.campaign.columns import schema


def test_columns_are_case_status_error_what_varies_and_results(campaign_file):
    columns = schema(read_campaign(campaign_file()))
    assert columns.names == [
        *("case", "status", "error", "inserted_mm", "segments.0.turn_deg"),
        *("largest_lag_deg", "largest_lag_time_s", "end_lag_deg", "largest_base_torque_n_mm"),
        *("end_tip_deg", "unconverged_count"),
    ]


@pytest.mark.parametrize(
    ("values", "kind"),
    [([1, 2.5], "double"), ([None, 3], "double"), ([True, False], "bool"), (["chicken"], "string")],
)
def test_a_column_has_the_type_of_what_varies(campaign_file, values, kind):
    campaign = read_campaign(campaign_file(vary={"tissue": {"grid": values}}, samples=1))
    assert str(schema(campaign).field("tissue").type) == kind
