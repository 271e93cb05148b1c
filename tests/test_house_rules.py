"""The layout is the architecture: imports run one way. And other rules of the house."""

import ast
import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PACKAGES = (
    *("models", "sim", "controllers", "diagnosis", "studies", "validation", "scripts"),
    *("benchmarks", "tests"),
)
MAY_IMPORT = {
    "models": {"models"},
    "controllers": {"controllers", "models"},
    "sim": {"sim", "controllers", "models"},
    "diagnosis": {"diagnosis", "sim", "models"},
    "studies": {"studies", "diagnosis", "controllers", "sim", "models"},
    "validation/rig": {"validation"},
    "validation/logs": {"validation"},
    "validation/score": {"validation", "diagnosis", "sim", "models"},
    "scripts": {"scripts", "studies", "diagnosis", "controllers", "sim", "models"},
}
ROOMS_OF_VALIDATION = ("rig", "logs", "score")
SIDE_STREAMS = {"sim/rerun_log.py", "sim/rerun_table.py"}


def sources(package):
    return sorted((ROOT / package).rglob("*.py"))


def imported(path):
    tree = ast.parse(path.read_text())
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


# The one command that validates the product from outside.
VALIDATES = "scripts/blind.py"


@pytest.mark.parametrize("package", MAY_IMPORT)
def test_imports_run_one_way(package):
    for path in sources(package):
        ours = {name.split(".")[0] for name in imported(path)} & set(PACKAGES)
        validates = {"validation"} if path.relative_to(ROOT).as_posix() == VALIDATES else set()
        assert ours <= MAY_IMPORT[package] | validates, path


@pytest.mark.parametrize("room", ROOMS_OF_VALIDATION)
def test_in_validation_imports_run_from_rig_to_logs_to_score(room):
    allowed = ROOMS_OF_VALIDATION[: ROOMS_OF_VALIDATION.index(room) + 1]
    paths = sources(f"validation/{room}")
    assert 0 < sum(path.name != "__init__.py" for path in paths) <= 12
    for path in paths:
        ours = {name.split(".")[1] for name in imported(path) if name.startswith("validation.")}
        assert ours <= set(allowed), path


def test_the_score_knows_of_sim_and_models_only_files_and_errors():
    for path in sources("validation/score"):
        theirs = {name for name in imported(path) if name.split(".")[0] in ("sim", "models")}
        assert theirs <= {"sim.files", "models.errors"}, path


def test_controllers_and_models_know_no_simulator():
    for package in ("models", "controllers"):
        for path in sources(package):
            assert "mujoco" not in {name.split(".")[0] for name in imported(path)}, path


def test_the_diagnosis_reaches_no_controller():
    """Not through another package either: what it imports, and what that imports."""
    reached, todo = set(), sources("diagnosis")
    while todo:
        path = todo.pop()
        if path not in reached:
            reached.add(path)
            todo += [file for name in imported(path) for file in modules(name)]
    assert ROOT / "sim/simulation.py" in reached
    assert not reached & set(sources("controllers"))


def modules(name):
    """Files of an imported name, the packages that it is in among them; none of other projects."""
    parts = name.split(".")
    inside = [ROOT.joinpath(*parts[:i], "__init__.py") for i in range(1, len(parts) + 1)]
    return [file for file in (ROOT.joinpath(*parts).with_suffix(".py"), *inside) if file.exists()]


def test_physics_never_imports_rerun():
    for package in ("models", "sim", "controllers"):
        for path in sources(package):
            if path.relative_to(ROOT).as_posix() in SIDE_STREAMS:
                continue
            names = set(imported(path))
            assert not any(n.split(".")[0] == "rerun" or n.startswith("sim.rerun") for n in names), path


def test_print_and_pickle_stay_out_of_the_library():
    for package in ("models", "sim", "controllers", "diagnosis", "studies"):
        for path in sources(package):
            text = path.read_text()
            assert not re.search(r"(?<![\w.])print\(", text), path
            assert "pickle" not in set(imported(path)), path


def test_every_public_function_class_and_module_says_what_it_is():
    for package in MAY_IMPORT:
        for path in sources(package):
            tree = ast.parse(path.read_text())
            if path.read_text().strip():
                assert ast.get_docstring(tree), path
            for node in tree.body:
                public = isinstance(node, ast.FunctionDef | ast.ClassDef) and node.name[0] != "_"
                assert not public or ast.get_docstring(node), f"{path}: {node.name}"


def test_every_argument_is_annotated():
    for package in MAY_IMPORT:
        for path in sources(package):
            for node in ast.walk(ast.parse(path.read_text())):
                if isinstance(node, ast.FunctionDef):
                    for argument in (*node.args.args, *node.args.kwonlyargs):
                        named = argument.arg in ("self", "cls")
                        assert named or argument.annotation, f"{path}: {node.name}({argument.arg})"


def test_the_constraints_pin_what_the_project_needs_and_name_no_address():
    text = (ROOT / "constraints.txt").read_text()
    assert "://" not in text
    assert all(re.fullmatch(r"[\w.-]+==[\w.]+", line) for line in text.split())
    pinned = {line.split("==")[0].lower().replace("_", "-") for line in text.split()}
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    needed = project["dependencies"] + project["optional-dependencies"]["dev"]
    assert {re.split(r"[><=\[]", n)[0].lower() for n in needed} <= pinned


def test_every_package_is_listed_for_installation():
    listed = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]["packages"]
    found = {
        ".".join(path.parent.relative_to(ROOT).parts)
        for package in (*(name for name in MAY_IMPORT if "/" not in name), "validation", "benchmarks")
        for path in sources(package)
    }
    assert set(listed) == found
