"""The contents of paper.json."""

import json

import pytest

from studies.published.report.contents import FORMAT, as_json


@pytest.fixture(scope="module")
def contents(study):
    return as_json(study)


def test_the_contents_are_plain_json(contents):
    assert json.loads(json.dumps(contents, allow_nan=False)) == contents
    assert contents["format"] == FORMAT == "paper-gap/1"


def test_each_material_has_its_verdict(contents):
    plastisol, gelatin = (contents["materials"][m] for m in ("plastisol", "gelatin"))
    assert contents["verdict"] == plastisol["verdict"] == "explained"
    assert (plastisol["effects"], gelatin["effects"]) == (
        ["base_servo", "shear_thinning"],
        ["coulomb_friction"],
    )


def test_figures_are_published_simulated_and_their_ratio(contents):
    settling = contents["materials"]["plastisol"]["figures"][5]
    ours = settling["ours"]["50 mm free"]
    assert ours["ratio"] == pytest.approx(ours["value"] / 1.02)
    assert ours["ratio"] == pytest.approx(1.8, abs=0.02)
    assert ours["missed_spreads"] == pytest.approx((ours["value"] - 1.02) / settling["spread"])


def test_the_keys_are_those_of_the_format(contents):
    assert list(contents) == [
        "format",
        "verdict",
        "sentence",
        "spread_of_tables_iv_v",
        "materials",
        "limits",
        "sets_that_pass_by_spread",
        "table_v_damping_share",
        "insertions",
        "compensator",
        "next_experiments",
        "next_experiment",
        "warnings",
    ]
    assert list(contents["table_v_damping_share"][0]) == ["free_mm", "value", "spread"]
    assert list(contents["compensator"][0]) == [
        "name",
        "reading",
        "published",
        "ours",
        "unit",
        "ratio",
    ]
    assert list(contents["materials"]["plastisol"]["candidates"][0]) == [
        "effects",
        "reading",
        "accepted",
        "meets_the_figures",
        "contradiction",
        "parameters",
        "gap",
        "chi_square",
        "degrees_of_freedom",
        "p_value",
        "aicc",
        "figures",
        "left_out_missed_spreads",
        "still_open",
        "cannot_close",
        "in_words",
    ]
    assert list(contents["insertions"]["hypotheses"][0]) == [
        "name",
        "basis",
        "value",
        "unit",
        "base_only_mm",
        "compensated_mm",
        "rms_residual",
        "meets_both",
        "in_words",
        "worse_than_stated",
    ]
    assert list(contents["next_experiments"][0]) == [
        "experiment",
        "measure",
        "depth_mm",
        "unit",
        "spread",
        "predicted",
        "tells_apart",
    ]


def test_the_insertions_stand_beside_12_and_4_mm(contents):
    found = contents["insertions"]
    assert found["published_mm"] == {"base_only": 12.0, "compensated": 4.0}
    by_name = {h["name"]: h for h in found["hypotheses"]}
    # The numbers of docs/published-figures.md.
    assert by_name["stated"]["base_only_mm"] == pytest.approx(6.5, abs=0.05)
    assert by_name["stated"]["compensated_mm"] == pytest.approx(1.9, abs=0.06)
    assert by_name["larger damping"]["value"] == pytest.approx(3.25, abs=0.02)
    assert by_name["larger damping"]["worse_than_stated"][0] == "Fig. 3, lag, 10 cm"
    assert by_name["longer shaft"]["meets_both"]
