"""The console command, as a person runs it."""

import io
import json
from pathlib import Path

import mujoco
import pytest
from rich.console import Console

from scripts.main import main

EXAMPLE = Path(__file__).parent.parent / "examples"


def test_insert_writes_everything_it_names(tmp_path, capsys):
    model = tmp_path / "needle.xml"
    code = main(["insert", "--protocol", "fig5-5cm", "--out", str(tmp_path), "--mjcf", str(model)])
    assert code == 0
    said = capsys.readouterr().out.replace("\n", "")
    for ending in (".csv", ".parquet", ".png", ".rrd"):
        assert (tmp_path / f"fig5-5cm{ending}").stat().st_size > 1000
        assert f"fig5-5cm{ending}" in said
    assert mujoco.MjModel.from_xml_path(str(model)).nq > 10


def test_insert_runs_a_model_that_was_changed_in_its_file(tmp_path):
    model, ours, theirs = tmp_path / "needle.xml", tmp_path / "ours", tmp_path / "theirs"
    command = ["insert", "--protocol", "fig5-5cm"]
    assert main([*command, "--out", str(ours), "--mjcf", str(model)]) == 0
    text = model.read_text()
    assert text.count('timestep="0.01"') == 1
    model.write_text(text.replace('timestep="0.01"', 'timestep="0.02"'))
    assert main([*command, "--out", str(theirs), "--model", str(model)]) == 0
    rows = [len((folder / "fig5-5cm.csv").read_text().splitlines()) for folder in (ours, theirs)]
    assert rows[1] - 2 == pytest.approx((rows[0] - 2) / 2, abs=1)


@pytest.mark.parametrize("beside", [["--mjcf", "other.xml"], ["--controller", "feedforward"]])
def test_a_changed_model_is_refused_beside_another_choice(tmp_path, capsys, beside):
    command = ["insert", "--protocol", "fig5-5cm", "--out", str(tmp_path), "--model", "needle.xml"]
    assert main([*command, *beside]) == 2
    assert "--model" in capsys.readouterr().err + capsys.readouterr().out


def test_a_controller_without_a_name_is_refused(tmp_path, capsys):
    assert main(["insert", "--protocol", "fig5-5cm", "--controller", "", "--out", str(tmp_path)]) == 2
    assert "--controller" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_insert_takes_a_file(tmp_path):
    protocol = str(EXAMPLE / "protocol.yaml")
    assert main(["insert", "--protocol", protocol, "--out", str(tmp_path)]) == 0
    assert (tmp_path / "two-layers.csv").exists()


@pytest.mark.parametrize(
    ("command", "first"),
    [
        (["insert", "--protocol", "fig5-5cm"], "simulating fig5-5cm"),
        (["insert", "--protocol", "fig5-5cm", "--controller", "least_time"], "simulating fig5-5cm"),
        (["replay", str(EXAMPLE / "rig-log")], "replaying the nominal rig"),
    ],
)
def test_progress_tells_the_time_that_is_left_in_lines(tmp_path, capsys, command, first):
    assert main([*command, "--out", str(tmp_path)]) == 0
    told = capsys.readouterr().err.splitlines()
    assert told[0] == f"    0 s  {first}"
    assert [line.split("; ")[1].split()[0] for line in told[-3:]] == ["about"] * 3
    assert all(line.endswith(" s left") for line in told[-3:])


def test_insert_refuses_to_overwrite_before_it_works(tmp_path, capsys):
    kept = tmp_path / "fig5-5cm.png"
    kept.write_text("mine")
    assert main(["insert", "--protocol", "fig5-5cm", "--out", str(tmp_path)]) == 2
    assert "--force" in capsys.readouterr().err
    assert kept.read_text() == "mine"
    assert list(tmp_path.iterdir()) == [kept]


@pytest.mark.parametrize(
    "arguments",
    [
        ["insert", "--protocol", "fig99"],
        ["insert", "--protocol", "no/such/file.yaml"],
        ["replay", "no/such/log"],
        ["inspect", "no/such/file.rrd"],
    ],
)
def test_bad_input_is_one_clear_line_and_exit_2(arguments, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(arguments) == 2
    said = capsys.readouterr().err
    assert said.startswith(f"needle {arguments[0]}:")
    assert "Traceback" not in said
    assert list(tmp_path.iterdir()) == []


def test_the_poles_fit_in_80_columns_in_a_section_per_source():
    from scripts import validate
    from studies.crosscheck.findings import Findings, Pole, PoleSource

    case = {
        "length_mm": 200.0,
        "free_mm": 50.0,
        "drive": "torque",
    }
    found = [
        Pole(**case, mode=mode, measured=-1186.601, closed_form=-1186.0, source=source, bound=0.005)
        for source in (PoleSource.SECOND_ORDER, PoleSource.NATIVE)
        for mode in (1, 2, 3, 4)
    ]
    console = Console(width=80, file=io.StringIO())
    console.print(validate.poles_table(Findings(poles=found)))
    lines = console.file.getvalue().splitlines()
    assert sum("-1186.601 -1186.601 -1186.601 -1186.601" in line for line in lines) == 2
    assert [
        word for line in lines for word in ("second order", "without callbacks") if word in line
    ] == [
        "second order",
        "without callbacks",
    ]


@pytest.mark.parametrize(("value", "said", "code"), [(2, "fails", 1), (0.5, "holds", 0)])
def test_validate_exits_1_when_a_bound_fails(value, said, code, monkeypatch, capsys, tmp_path):
    from scripts import validate
    from studies.crosscheck.findings import Check, Findings

    found = Findings(checks=[Check(name="x", value=value, unit="-", high=1)])
    monkeypatch.setattr(validate, "cross_check", lambda progress: found)
    assert main(["validate", "--out", str(tmp_path / "v")]) == code
    assert said in capsys.readouterr().out
    written = json.loads((tmp_path / "v" / "validate.json").read_text())
    assert written["passed"] is (code == 0)


def test_protocols_lists_the_names(capsys):
    assert main(["protocols"]) == 0
    assert "fig4-10cm" in capsys.readouterr().out


def test_an_interrupted_run_says_so(monkeypatch, capsys, tmp_path):
    from scripts import insert

    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(insert, "perform", interrupted)
    assert main(["insert", "--protocol", "fig5-5cm", "--out", str(tmp_path)]) == 130
    assert list(tmp_path.iterdir()) == []
