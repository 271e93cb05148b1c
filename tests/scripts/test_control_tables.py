"""Step responses on a console of 80 columns: nothing is cut, nothing is missing."""

import io
import math

import pytest
from rich.console import Console

from scripts.control_tables import (
    failures_table,
    integral_table,
    robustness_tables,
    settling_table,
)
from scripts.tables import print_table
from studies.control.comparison import StepResponse
from studies.control.robustness import ROBUST_CONTROLLERS, misjudged_delays, plants
from studies.control.tables import CONTROLLERS


def response(controller, plant, settle_s, overshoot_deg=0.0):
    return StepResponse(
        tissue="viscous-plastisol",
        depth_cm=10.0,
        free_mm=50.0,
        controller=controller,
        settle_s=settle_s,
        integral_deg_s=123.4,
        overshoot_deg=overshoot_deg,
        largest_base_deg=300.0,
        published_settle_s=1.02,
        plant=plant,
        shear_stress_mpa=411.0,
        final_error_deg=11.7,
    )


def printed(table, width=80, keys=1):
    console = Console(width=width, file=io.StringIO(), color_system=None)
    print_table(console, table, keys=keys)
    return console.file.getvalue()


TABLES = [response(name, "viscous-plastisol", 0.6) for name in CONTROLLERS]
ROBUST = [
    response(name, plant, math.nan if name == "feedforward" else 0.62, 22.4)
    for plant in (*plants(), *misjudged_delays())
    for name in ROBUST_CONTROLLERS
]


@pytest.mark.parametrize("table", [settling_table(TABLES), integral_table(TABLES)])
def test_tables_iv_and_v_fit_80_columns_with_their_headings(table):
    text = printed(table)
    assert "…" not in text
    assert max(map(len, text.splitlines())) <= 80
    assert all(name in text for name in CONTROLLERS)
    assert "paper" in text
    assert "ratio" in text


def test_every_rig_and_controller_is_in_the_tables_of_robustness():
    texts = [printed(table) for table in robustness_tables(ROBUST)]
    whole = " ".join("".join(texts).split())
    assert "…" not in whole
    assert all(max(map(len, text.splitlines())) <= 80 for text in texts)
    assert "never 11.7" in whole
    assert "0.62 ^22" in whole
    for name in set(ROBUST_CONTROLLERS) - {"base_only"}:
        assert name.split("_")[0] in whole


def test_what_failed_is_listed_and_baselines_are_not():
    text = printed(failures_table(ROBUST))
    assert "…" not in text
    assert "overshoots by 22 deg" in text
    assert "base_only_at_limit" not in text


@pytest.mark.parametrize("width", [80, 60])
@pytest.mark.parametrize(
    ("table", "keys"),
    [
        (settling_table(TABLES), 3),
        (integral_table(TABLES), 3),
        *((table, 1) for table in robustness_tables(ROBUST)),
        (failures_table(ROBUST), 2),
    ],
)
def test_no_heading_and_no_number_is_cut_on_a_narrow_screen(table, keys, width):
    text = printed(table, width, keys)
    assert "…" not in text
    assert max(map(len, text.splitlines())) <= width
    words = {word for column in table.columns for word in str(column.header).split()}
    assert words <= set(text.split())
