"""The files of `needle control`, from a small study."""

import json
import math

import matplotlib.image
import pandas as pd
import pytest

from models.drive import DriveKind
from models.materials import tissue_named
from sim.files import Destination, publishing
from studies.control import report
from studies.control.comparison import compare
from studies.control.report import FILES, ControlStudy, hankel, write_study
from studies.crosscheck.poles import closed_form_needle


@pytest.fixture(scope="module")
def small(small_steering):
    responses = compare(
        tissue_named("viscous-plastisol"),
        depth_cm=5.0,
        free_mm=0.0,
        controllers=("base_only", "feedforward"),
        hold_s=2.0,
    )
    return ControlStudy(tables=responses, robustness=responses, steering=small_steering)


def test_every_file_is_written_and_says_the_same(small, tmp_path, monkeypatch):
    # The picture simulates its own turns.
    monkeypatch.setattr(report, "_STYLES", {"base_only": {}})
    paths = [tmp_path / name for name in FILES]
    with publishing(Destination(folder=tmp_path), paths) as results:
        write_study(small, results, tmp_path)
    assert results.made == paths
    content = json.loads(paths[0].read_text(), parse_constant=lambda c: pytest.fail(c))
    table = pd.read_csv(paths[1])
    assert [row["settle_s"] for row in content["table_iv"]] == pytest.approx(list(table["settle_s"]))
    assert content["table_iv"][0]["published_s"] == 0.67
    for path in paths[3:]:
        assert matplotlib.image.imread(path).std() > 0.01  # not blank


def test_what_does_not_exist_is_null_and_not_nan(small):
    content = small.as_json()
    never = content["planar_mm"]["10 mm/s"]["its own simulation"]
    assert math.isnan(small.steering.known_pose[10.0][0].converged_mm())
    assert never is None


def test_hankel_values_fall_and_four_of_them_hold_nearly_everything():
    ratios = hankel()
    assert ratios[0] == 1.0
    assert sum(ratios[3:]) < 0.01 * sum(ratios)
    assert closed_form_needle(200.0, 0.0, DriveKind.TORQUE).inserted_mm == 200.0


def test_a_notebook_shows_tables_iv_and_v(small):
    shown = small._repr_html_()
    assert "feedforward" in shown
    assert "0.67" in shown  # published for the base alone, 5 cm deep
