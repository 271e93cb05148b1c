"""The installed command runs our packages, whatever folders of their names are found first."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from scripts.console import PACKAGES

ROOT = Path(__file__).parent.parent
COMMAND = "import sys\nfrom needle_torsion_console import main\nsys.exit(main())\n"
# Which files a worker takes our packages from.
WORKER = """
import sys
from multiprocessing import get_context
from needle_torsion_console import PACKAGES, main

def origins():
    import models.errors
    return [sys.modules[name].__file__ for name in PACKAGES] + [models.errors.__file__]

if __name__ == "__main__":
    with get_context(sys.argv[1]).Pool(1) as pool:
        print(*pool.apply(origins), sep="\\n")
"""


@pytest.fixture
def installed(tmp_path):
    """Our packages under their installed names, and a folder for commands."""
    site = tmp_path / "site"
    (site / "bin").mkdir(parents=True)
    for name in PACKAGES:
        (site / name).symlink_to(ROOT / name)
    (site / "needle_torsion_console").symlink_to(ROOT / "scripts" / "console")
    return site


@pytest.fixture
def users_folder(tmp_path):
    """Packages of our names that end the process if anything imports them."""
    folder = tmp_path / "users"
    for name in PACKAGES:
        (folder / name).mkdir(parents=True)
        for file in ("__init__.py", "main.py", "files.py", "errors.py"):
            (folder / name / file).write_text(f"raise SystemExit('imported {name}/{file} of the user')")
    return folder


def run(installed, folder, code, *arguments, path):
    command = installed / "bin" / "needle"
    command.write_text(code)
    return subprocess.run(
        [sys.executable, str(command), *arguments],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": path.format(site=installed, users=folder)},
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )


# Empty entries are the current folder.
@pytest.mark.parametrize("path", ["{site}", "{users}:{site}", "{site}:"])
def test_the_command_begins_beside_folders_of_the_same_names(installed, users_folder, path):
    done = run(installed, users_folder, COMMAND, "--help", path=path)
    assert done.returncode == 0, done.stderr
    assert "usage: needle" in done.stdout


def test_the_command_simulates_with_our_packages(installed, users_folder):
    done = run(installed, users_folder, COMMAND, "protocols", path=":{site}")
    assert done.returncode == 0, done.stderr
    assert "fig4-10cm" in done.stdout


@pytest.mark.parametrize("start", ["fork", "spawn", "forkserver"])
def test_worker_processes_take_our_packages_too(installed, users_folder, start):
    done = run(installed, users_folder, WORKER, start, path=":{site}")
    assert done.returncode == 0, done.stderr
    assert len(done.stdout.split()) == len(PACKAGES) + 1
    assert [o for o in done.stdout.split() if not o.startswith(str(installed))] == []


def test_without_the_guard_the_folders_of_the_user_would_be_taken(installed, users_folder):
    bare = COMMAND.replace("needle_torsion_console", "scripts.main")
    done = run(installed, users_folder, bare, "--help", path=":{site}")
    assert done.returncode != 0
    assert "scripts/__init__.py of the user" in done.stderr


def test_the_guard_leaves_the_search_path_as_it_was(installed, users_folder):
    code = "import sys\nbefore = [*sys.path]\nimport needle_torsion_console\nassert sys.path == before\n"
    done = run(installed, users_folder, code, path=":{site}")
    assert done.returncode == 0, done.stderr
