"""The columns of a campaign's results: one row per case."""

from typing import Any

import pyarrow as pa

from studies.campaign.campaign import Campaign, Kind
from studies.campaign.variation import Variation

Row = dict[str, Any]

DONE, FAILED = "done", "failed"

_INSERTION = {
    "largest_lag_deg": pa.float64(),
    "largest_lag_time_s": pa.float64(),
    "end_lag_deg": pa.float64(),
    "largest_base_torque_n_mm": pa.float64(),
    "end_tip_deg": pa.float64(),
    "unconverged_count": pa.int64(),
}
_CONTROL = {"end_tip_error_deg": pa.float64(), "largest_estimate_error_deg": pa.float64()}
# Parquet names what is in a list "element": a type that comes back as it was written.
_POSTERIOR = {"tip_error_deg": pa.list_(pa.field("element", pa.float64()))}
_DIAGNOSIS = {
    "log": pa.string(),
    "verdict": pa.string(),
    "effects": pa.string(),
    "gap_before": pa.float64(),
    "gap_after": pa.float64(),
    "probability": pa.float64(),
}
RESULTS: dict[Kind, dict[str, pa.DataType]] = {
    Kind.INSERTION: _INSERTION,
    Kind.CONTROL: _INSERTION | _CONTROL,
    Kind.DIAGNOSIS: _DIAGNOSIS,
    Kind.POSTERIOR: _INSERTION | _POSTERIOR,
}
"""By kind: results and their types; units are in the names, gaps are in sigma."""


def schema(campaign: Campaign) -> pa.Schema:
    """Names and types of all columns; the metadata hold the campaign's fingerprint."""
    columns = {"case": pa.int64(), "status": pa.string(), "error": pa.string()}
    columns |= {path: _type_of(variation) for path, variation in campaign.vary.items()}
    columns |= dict.fromkeys(campaign.posterior.parameters if campaign.posterior else (), pa.float64())
    columns |= RESULTS[campaign.kind]
    return pa.schema(list(columns.items()), metadata={"campaign": campaign.fingerprint})


def _type_of(variation: Variation) -> pa.DataType:
    """Numbers are float64, truth values bool, and everything else is text."""
    kinds = {type(value) for value in variation.support if value is not None}
    if kinds <= {int, float}:
        return pa.float64()
    return pa.bool_() if kinds == {bool} else pa.string()
