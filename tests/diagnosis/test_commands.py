"""`needle replay` and `needle diagnose`, as a person runs them."""

import json
import re
from itertools import product

import numpy as np
import pandas as pd
import pytest
from analytic_log import change_trial, write_log

from diagnosis.in_sigma import over_sigma
from diagnosis.log.trial import SENSORS
from diagnosis.nominal_replay import replay_nominal
from diagnosis.report import write
from diagnosis.report.answer import answer
from diagnosis.report.fallible import Page
from diagnosis.report.sentences.residual import largest_parts
from models.errors import UnwritableOutput
from scripts import diagnose as command
from scripts import replay as replaying
from scripts.main import main
from sim.files import ResultSet
from sim.recording.rerun_table import entries

PAGE = Page(text="a page", lacks=())


@pytest.fixture
def wide(monkeypatch):
    """A screen on which no line is broken."""
    monkeypatch.setenv("COLUMNS", "200")


def test_a_rig_with_nothing_unmodelled_gives_no_alarm(nothing):
    """The command itself, over processes: what it prints is report.json."""
    assert nothing.report["verdict"] == "none"
    assert nothing.report["effects"] == []


def test_a_log_that_cannot_be_used_exits_2(tmp_path, capsys):
    assert main(["diagnose", str(tmp_path / "nowhere")]) == 2
    assert "rig.yaml" in capsys.readouterr().err


def test_diagnose_asks_for_a_log_or_the_paper(capsys):
    assert main(["diagnose"]) == 2
    assert "--paper" in capsys.readouterr().err
    assert main(["diagnose", "examples/rig-log", "--paper"]) == 2


def test_a_summary_is_printed_and_every_file_is_named(dry, tmp_path, monkeypatch, capsys, wide):
    monkeypatch.setattr(command, "diagnose", lambda log, **_: dry.found)
    monkeypatch.setattr(write, "_page_begun", lambda *_: lambda: PAGE)  # its pictures take a second
    assert main(["diagnose", str(dry.folder), "--out", str(tmp_path / "out")]) == 0
    said = capsys.readouterr().out
    assert all(sentence in " ".join(said.split()) for sentence in answer(dry.found))
    for name in ("report.json", "report.html", "gap.rrd", "trial_03.csv"):
        assert name in said
    assert (tmp_path / "out" / "report.html").is_file()
    assert re.search(r"coulomb_friction\s+│ level\s+│ 0\.001", said)
    told = dry.found.assessment
    before, after = (parts.signal["tip_angle_deg"] for parts in (told.breakdown, told.breakdown_after))
    assert re.search(rf"tip_angle_deg\s+│ {over_sigma(before)}\s+│ {over_sigma(after)}", said)
    assert largest_parts(dry.found) in said


def test_the_answer_is_printed_also_where_no_report_can_be_written(dry, tmp_path, monkeypatch, capsys):
    def unwritable(*_):
        raise UnwritableOutput("the disk is full")

    monkeypatch.setattr(command, "diagnose", lambda log, **_: dry.found)
    monkeypatch.setattr(command, "write_report", unwritable)
    assert main(["diagnose", str(dry.folder), "--out", str(tmp_path / "out")]) == 2
    said = capsys.readouterr()
    assert answer(dry.found)[0] in " ".join(said.out.split())
    assert "the disk is full" in said.err


def test_a_report_that_exists_is_kept_before_any_work_is_done(dry, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(command, "diagnose", pytest.fail)
    (tmp_path / "report.json").write_text("mine")
    assert main(["diagnose", str(dry.folder), "--out", str(tmp_path)]) == 2
    assert "--force" in capsys.readouterr().err
    assert (tmp_path / "report.json").read_text() == "mine"


@pytest.fixture(scope="session")
def replayed(dry, tmp_path_factory):
    """What `needle replay` writes of the log with dry friction."""
    folder = tmp_path_factory.mktemp("replay")
    assert main(["replay", str(dry.folder), "--out", str(folder)]) == 0
    return folder


def test_replay_writes_predictions_picture_and_recording(replayed, capsys, wide):
    assert (replayed / "replay.png").stat().st_size > 1000
    assert (replayed / "predictions" / "trial_01.csv").read_text().startswith("time_s,")
    assert main(["inspect", "--table", str(replayed / "replay.rrd")]) == 0
    said = capsys.readouterr().out
    for signal in ("angles/tip_angle_deg", "angles/measured_tip_deg", "torque/measured_torque_n_mm"):
        assert signal in said


def test_the_recording_of_a_replay_has_what_was_measured_at_its_own_samples(replayed, dry):
    found = {e.entity: e for e in entries(replayed / "replay.rrd")}
    first = dry.log.trials[0]
    for entity, column in (
        ("/angles/measured_tip_deg", "tip_angle_deg"),
        ("/torque/measured_torque_n_mm", "base_torque_n_mm"),
    ):
        assert found[entity].rows == len(first.table)
        assert found[entity].last == pytest.approx(first[column][-1])


def test_diagnose_without_out_writes_a_report_to_a_folder_of_its_own(
    dry, tmp_path, monkeypatch, capsys, wide
):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(command, "diagnose", lambda log, **_: dry.found)
    monkeypatch.setattr(write, "_page_begun", lambda *_: lambda: PAGE)
    for folder in ("out/diagnose", "out/diagnose-2"):
        assert main(["diagnose", str(dry.folder)]) == 0
        assert f"wrote      {folder}/report.html" in capsys.readouterr().out
        assert (tmp_path / folder / "report.html").is_file()
    assert main(["diagnose", str(dry.folder), "--force"]) == 0
    assert not (tmp_path / "out" / "diagnose-3").exists()


def test_json_alone_goes_to_the_screen_and_to_no_file(dry, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(command, "diagnose", lambda log, **_: dry.found)
    assert main(["diagnose", str(dry.folder), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["effects"] == ["coulomb_friction"]
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("width", [80, 60])
def test_the_summary_fits_the_screen(dry, tmp_path, monkeypatch, capsys, width):
    monkeypatch.setenv("COLUMNS", str(width))
    monkeypatch.setattr(command, "diagnose", lambda log, **_: dry.found)
    monkeypatch.setattr(write, "_page_begun", lambda *_: lambda: PAGE)
    assert main(["diagnose", str(dry.folder), "--out", str(tmp_path / "out")]) == 0
    said = capsys.readouterr().out
    assert "…" not in said
    told = [line for line in said.splitlines() if not line.startswith("wrote")]  # paths stay whole
    assert max(map(len, told)) <= width


def test_replay_and_diagnose_predict_the_same_of_the_nominal_rig(replayed, dry):
    for trial, nominal in zip(dry.log.trials, dry.found.nominal, strict=True):
        table = pd.read_csv(replayed / "predictions" / trial.name)
        for sensor in SENSORS:
            # Six digits are written.
            np.testing.assert_allclose(
                table[f"{sensor}_nominal"], nominal[sensor], rtol=1e-5, atol=1e-12
            )


def test_the_gap_that_replay_shows_is_that_of_diagnose_but_for_the_noise(dry):
    nominal = replay_nominal(dry.log)
    sizes = [trial.time_s.size for trial in nominal.problem.log.trials]
    for sensor in SENSORS:
        gaps = [replaying.gap(nominal, sensor, i) for i in range(len(sizes))]
        pooled = replaying.gap(nominal, sensor)
        assert pooled == pytest.approx(np.sqrt(np.average(np.square(gaps), weights=sizes)), rel=1e-12)
        noises = nominal.problem.noise[sensor] / dry.found.noise[sensor]
        assert dry.found.assessment.breakdown.signal[sensor] / pooled == pytest.approx(noises, rel=1e-12)


def test_the_table_of_replay_has_a_row_for_each_trial(dry):
    nominal = replay_nominal(dry.log)
    table = replaying.table(nominal)
    rows = [len(trial.table) for trial in dry.log.trials]
    assert list(table.columns[0].cells) == [*(t.name for t in dry.log.trials), "all"]
    assert list(table.columns[1].cells) == [str(n) for n in (*rows, sum(rows))]


@pytest.fixture
def replay_of(tmp_path, monkeypatch, capsys, wide):
    """Replays the analytic log with a change of both trials; exit code, stdout and stderr."""
    log = write_log(tmp_path / "log")

    def replay(change):
        unwritten = ResultSet(tmp_path, [], tmp_path)
        monkeypatch.setattr(replaying, "write", lambda *_: unwritten)  # its files take a second
        for name in ("turns.csv", "slides.csv"):
            change_trial(log, lambda t: change(t).iloc[:300], name)
        code = main(["replay", str(log), "--out", str(tmp_path / "out")])
        return code, *capsys.readouterr()

    return replay


def test_replay_names_columns_in_radians_and_newton_metres_before_and_beside_the_result(replay_of):
    rad = {name: np.pi / 180 for name in ("base_angle_deg", "tip_angle_deg")}
    factors = rad | {"base_torque_n_mm": 1e-3}
    code, *both = replay_of(lambda t: t.assign(**{name: f * t[name] for name, f in factors.items()}))
    assert code == 0
    for said, column in product(both, factors):
        assert len(re.findall(rf"warning: turns\.csv, slides\.csv: {column} scatters by", said)) == 1
        assert f"{column}: the readings scatter" not in said


def test_replay_refuses_an_angle_that_wraps(replay_of):
    code, _, said = replay_of(lambda t: t.assign(base_angle_deg=(t["base_angle_deg"] + 45) % 180 - 90))
    assert code == 2
    assert "base_angle_deg wraps" in said
    assert "numpy.unwrap(values, period=180)" in said


def test_diagnose_tells_warnings_of_the_log_before_anything_is_simulated(tmp_path, monkeypatch, capsys):
    log = write_log(tmp_path / "log")
    for name in ("turns.csv", "slides.csv"):
        change_trial(log, lambda t: t.assign(tip_angle_deg=np.radians(t["tip_angle_deg"])), name)

    def simulated(*_, **__):
        raise RuntimeError("simulated")

    monkeypatch.setattr(command, "diagnose", simulated)
    with pytest.raises(RuntimeError, match="simulated"):
        main(["diagnose", str(log)])
    said = " ".join(capsys.readouterr().err.split())
    assert "warning: turns.csv, slides.csv: tip_angle_deg scatters by" in said
