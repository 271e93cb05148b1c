"""What an installation holds: everything that runs, and nothing else."""

import shutil
import subprocess
import sys
import tomllib
from importlib.metadata import version
from pathlib import Path
from zipfile import ZipFile

import pytest
import yaml

ROOT = Path(__file__).parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
RUNS = ("models", "sim", "controllers", "diagnosis", "studies", "validation", "scripts", "benchmarks")
NEEDED = (77,)  # setuptools that knows licenses by their names


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """Built as by `make package`, without a network; through the sdist, so that that is whole too."""
    if tuple(map(int, version("setuptools").split(".")[:1])) < NEEDED:
        pytest.skip("the environment has an old setuptools; make setup brings a newer one")
    out, source = tmp_path_factory.mktemp("dist"), tmp_path_factory.mktemp("source") / "needle"
    # Compiled code comes and goes beside the sources while other tests run.
    shutil.copytree(
        ROOT, source, ignore=shutil.ignore_patterns("__pycache__", ".*", "out", "*.egg-info")
    )
    command = [sys.executable, "-m", "build", "--no-isolation", "--outdir", str(out), str(source)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert len(list(out.glob("*.tar.gz"))) == 1
    return ZipFile(next(out.glob("*.whl")))


def installed_names():
    """Files of the repository that run, by their installed names."""
    modules = {
        path.relative_to(ROOT).as_posix() for name in RUNS for path in (ROOT / name).rglob("*.py")
    }
    renamed = {name.replace("scripts/console/", "needle_torsion_console/") for name in modules}
    examples = (path for path in (ROOT / "examples").rglob("*") if path.is_file())
    return renamed | {f"scripts/{path.relative_to(ROOT).as_posix()}" for path in examples}


@pytest.mark.slow
def test_the_wheel_holds_what_runs_and_the_examples_and_no_tests(wheel):
    held = {name for name in wheel.namelist() if ".dist-info/" not in name}
    typed = {f"{name}/py.typed" for name in RUNS[:-1]}
    assert held == installed_names() | typed


@pytest.mark.slow
def test_the_wheel_knows_its_license_and_its_command(wheel):
    about = {Path(name).name: name for name in wheel.namelist() if ".dist-info/" in name}
    metadata = wheel.read(about["METADATA"]).decode()
    assert "License-Expression: Apache-2.0" in metadata
    assert "Apache License" in wheel.read(about["LICENSE"]).decode()
    assert "needle = needle_torsion_console:main" in wheel.read(about["entry_points.txt"]).decode()


def test_license_citation_and_version_agree():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    license_text = (ROOT / "LICENSE").read_text()
    assert citation["version"] == PROJECT["version"]
    assert citation["license"] == PROJECT["license"] == "Apache-2.0"
    assert citation["authors"] == PROJECT["authors"] == [{"name": "The needle-torsion authors"}]
    assert "Copyright 2026 The needle-torsion authors" in license_text
    assert "END OF TERMS AND CONDITIONS" in license_text


def test_the_changelog_tells_of_this_version():
    assert PROJECT["version"] in (ROOT / "CHANGELOG.md").read_text()
