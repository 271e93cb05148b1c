"""The layout is the architecture: imports run one way. And other rules of the house."""

import ast
import re
import tomllib
from functools import cache
from graphlib import CycleError, TopologicalSorter
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
    "sim": {"sim", "models"},
    "diagnosis": {"diagnosis", "sim", "models"},
    "studies": {"studies", "diagnosis", "controllers", "sim", "models"},
    "validation/rig": {"validation"},
    "validation/logs": {"validation"},
    "validation/score": {"validation", "diagnosis", "sim", "models"},
    "scripts": {"scripts", "studies", "diagnosis", "controllers", "sim", "models"},
}
ROOMS_OF_VALIDATION = ("rig", "logs", "score")
# Inside a package the direction is one too: of its folders, each imports only these.
MAY_IMPORT_INSIDE = {
    "sim.files": {"sim.files"},
    "sim.kernel": {"sim.kernel", "sim.kernel.native", "sim.kernel.site", "sim.kernel.stage"},
    "sim.kernel.site": {"sim.kernel", "sim.kernel.site"},
    "sim.kernel.native": {"sim.kernel", "sim.kernel.native"},
    "sim.kernel.stage": {"sim.kernel", "sim.kernel.site", "sim.kernel.stage"},
    "sim.loop": {"sim.loop"},
    "sim.needles": {"sim", "sim.kernel", "sim.kernel.native", "sim.needles"},
    "sim.recording": {"sim", "sim.files", "sim.kernel", "sim.needles", "sim.recording"},
    "studies.campaign": {"studies.campaign", "studies.campaign.posterior", "studies.control"},
    "studies.campaign.posterior": {"studies.campaign.posterior"},
    "studies.crosscheck": {"studies.crosscheck"},
    "controllers.steering": {"controllers", "controllers.steering"},
    "studies.control": {"studies.control", "studies.control.steering", "studies.crosscheck"},
    "studies.published": {
        *("studies.published", "studies.control", "studies.crosscheck"),
        *(f"studies.published.{room}" for room in ("experiments", "fitting", "selection", "report")),
    },
}
RERUN = ("file", "layout", "log", "plots", "series", "shaft", "table")
SIDE_STREAMS = {f"sim/recording/rerun_{name}.py" for name in RERUN}


def sources(package):
    return sorted((ROOT / package).rglob("*.py"))


@cache
def nodes_of(path):
    """All nodes of a module's syntax tree, the module itself first."""
    return tuple(ast.walk(ast.parse(path.read_text())))


def imported(path):
    for node in nodes_of(path):
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


@pytest.mark.parametrize("folder", MAY_IMPORT_INSIDE)
def test_imports_run_one_way_inside_a_package_too(folder):
    package = folder.split(".")[0]
    for path in sources(folder.replace(".", "/")):
        inside = {name for name in imported(path) if name.split(".")[0] == package}
        assert {_folder_of(name) for name in inside} <= MAY_IMPORT_INSIDE[folder], path


def _folder_of(name):
    """The package that holds a module or a name of one, or a package itself."""
    parts = name.split(".")
    while not ROOT.joinpath(*parts).is_dir():
        parts = parts[:-1]
    return ".".join(parts)


def _module(path):
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def _imported_modules(path, modules):
    """Modules that a file imports, whether as a module or as a name from its package."""
    for node in nodes_of(path):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in modules)
        elif isinstance(node, ast.ImportFrom) and node.module:
            names = {f"{node.module}.{alias.name}" for alias in node.names} & modules
            yield from names or {node.module} & modules


def test_no_module_imports_itself_by_way_of_others():
    paths = {_module(path): path for package in MAY_IMPORT for path in sources(package)}
    graph = {name: set(_imported_modules(path, set(paths))) for name, path in paths.items()}
    TopologicalSorter(graph).prepare()  # raises CycleError, which names the modules
    looped = graph | {"models.errors": {"models.needle"}}
    with pytest.raises(CycleError):
        TopologicalSorter(looped).prepare()


@pytest.mark.parametrize("room", ROOMS_OF_VALIDATION)
def test_in_validation_imports_run_from_rig_to_logs_to_score(room):
    allowed = ROOMS_OF_VALIDATION[: ROOMS_OF_VALIDATION.index(room) + 1]
    paths = sources(f"validation/{room}")
    assert paths
    for path in paths:
        ours = {name.split(".")[1] for name in imported(path) if name.startswith("validation.")}
        assert ours <= set(allowed), path


def test_the_score_knows_of_sim_and_models_only_files_and_errors():
    known = ("sim.files", "models.errors")
    for path in sources("validation/score"):
        theirs = {name for name in imported(path) if name.split(".")[0] in ("sim", "models")}
        assert all(name.startswith(known) for name in theirs), path


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
            assert not any(
                n.split(".")[0] == "rerun" or n.startswith("sim.recording.rerun") for n in names
            ), path


def test_print_and_pickle_stay_out_of_the_library():
    for package in ("models", "sim", "controllers", "diagnosis", "studies"):
        for path in sources(package):
            text = path.read_text()
            assert not re.search(r"(?<![\w.])print\(", text), path
            assert "pickle" not in set(imported(path)), path


def test_every_public_function_class_and_module_says_what_it_is():
    for package in MAY_IMPORT:
        for path in sources(package):
            tree = nodes_of(path)[0]
            if path.read_text().strip():
                assert ast.get_docstring(tree), path
            for node in tree.body:
                public = isinstance(node, ast.FunctionDef | ast.ClassDef) and node.name[0] != "_"
                assert not public or ast.get_docstring(node), f"{path}: {node.name}"


def test_every_argument_is_annotated():
    for package in MAY_IMPORT:
        for path in sources(package):
            for node in nodes_of(path):
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
    needed = sum(project["optional-dependencies"].values(), project["dependencies"])
    assert {re.split(r"[><=\[]", n)[0].lower() for n in needed} <= pinned


@pytest.mark.parametrize("package", ["models", "sim", "controllers", "studies"])
def test_every_module_has_a_test_at_the_same_place_that_names_it(package):
    for path in sources(package):
        if path.name != "__init__.py":
            place = path.relative_to(ROOT)
            test = ROOT / "tests" / place.with_name(f"test_{path.name}")
            assert test.exists(), test.relative_to(ROOT)
            assert {_module(path), path.stem} & set(_names_in(test)), f"{place} is not imported there"


def _names_in(path):
    """What a test imports, and what it takes from the kernel in the interpreter."""
    for node in nodes_of(path):
        if isinstance(node, ast.ImportFrom) and node.module:
            yield from (node.module, *(f"{node.module}.{alias.name}" for alias in node.names))
        elif isinstance(node, ast.Attribute) and getattr(node.value, "id", "") == "interpreted":
            yield node.attr


def test_every_package_is_listed_for_installation():
    tool = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]
    folders = tool["package-dir"]
    listed = [folders.get(name, name).replace("/", ".") for name in tool["packages"]]
    found = {
        ".".join(path.parent.relative_to(ROOT).parts)
        for package in (*(name for name in MAY_IMPORT if "/" not in name), "validation", "benchmarks")
        for path in sources(package)
    }
    assert set(listed) == found | {"examples"}
