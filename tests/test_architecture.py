"""The rooms of the diagnosis and what they promise: one direction, one name, one place for numbers."""

import ast
from collections import Counter, defaultdict
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PACKAGES = ("models", "sim", "controllers", "diagnosis", "studies", "validation", "scripts")
ROOMS = (
    "criteria",
    "in_sigma",
    "stopping",
    "stages",
    "time_left",
    "progress",
    "cores",
    "workers",
    "engines",
    "log",
    "lab_files",
    "prepare",
    "replay",
    "residuals",
    "effects",
    "fitting",
    "lost_counts",
    "nominal_replay",
    "selection",
    "assessment",
    "freeform",
    "result",
    "report",
    "pipeline",
)
"""From the ground up: a room imports those before it."""
MOST_MODULES = 12
# Units that a name may end in, and words for what has none.
UNITS = (
    "_mm",
    "_deg",
    "_percent",
    "_s",
    "_hz",
    "_gpa",
    "_cm3",
    "_rad",
    "_n_mm",
    "_mm2",
    "_kg_m",
    "_kg_m2",
    *("_mm_s", "_sigma"),
)
PER = ("_per_",)
DIMENSIONLESS = (
    *("scale", "share", "ratio", "fraction", "exponent", "coefficient", "probability", "factor"),
    *("likeness", "period", "asymmetry", "chi_square"),
    *(
        "score",
        "cost",
        "gain",
        "gap",
        "slow",
        "limit",
        "shift",
        "separation",
        "correlation",
        "shrink",
        "before",
        "after",
    ),
)
"""Scores, costs and gaps are in units of the noise (criteria/)."""


def modules(package):
    return [p for p in sorted((ROOT / package).rglob("*.py")) if p.name != "__init__.py"]


@cache
def trees(package):
    return [(path, ast.parse(path.read_text())) for path in modules(package)]


def imported(tree):
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module:
            yield node.module
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


def room_of(path):
    return path.relative_to(ROOT / "diagnosis").with_suffix("").parts[0]


def test_every_room_of_the_diagnosis_is_in_the_order():
    assert {room_of(path) for path in modules("diagnosis")} == set(ROOMS)


@pytest.mark.parametrize(("path", "tree"), trees("diagnosis"), ids=lambda v: getattr(v, "stem", ""))
def test_rooms_import_only_those_before_them(path, tree):
    own = ROOMS.index(room_of(path))
    for name in imported(tree):
        parts = name.split(".")
        if parts[0] == "diagnosis" and len(parts) > 1:
            assert ROOMS.index(parts[1]) <= own, f"{path.name} imports {name}"


@pytest.mark.parametrize("package", ["sim", "diagnosis", "studies", "validation"])
def test_a_folder_has_at_most_a_dozen_modules(package):
    counts = Counter(path.parent for path in modules(package) if path.parent.name != "effects")
    assert max(counts.values()) <= MOST_MODULES, counts.most_common(1)


def test_a_class_name_exists_once():
    found = defaultdict(list)
    for package in PACKAGES:
        for path, tree in trees(package):
            for node in tree.body:
                if isinstance(node, ast.ClassDef):
                    found[node.name].append(path.relative_to(ROOT).as_posix())
    assert not {name: paths for name, paths in found.items() if len(paths) > 1}


@pytest.mark.parametrize(("path", "tree"), trees("diagnosis"), ids=lambda v: getattr(v, "stem", ""))
def test_what_decides_is_named_in_criteria(path, tree):
    """No comparison with a bare number but 0, 1, 2 and tiny guards against rounding."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Compare):
            for side in (node.left, *node.comparators):
                if isinstance(side, ast.Constant) and isinstance(side.value, int | float):
                    allowed = side.value in (0, 1, 2) or abs(side.value) < 1e-6
                    assert allowed, f"{path.name}:{node.lineno} compares with {side.value}"


def has_unit(name):
    return name.endswith(UNITS) or any(p in name for p in PER)


def test_floats_of_records_carry_their_unit():
    """A name says the unit of what it holds, or that it has none."""
    bare = []
    for path, tree in trees("diagnosis"):
        for record in (n for n in tree.body if isinstance(n, ast.ClassDef)):
            for field in record.body:
                if isinstance(field, ast.AnnAssign) and ast.unparse(field.annotation) == "float":
                    name = field.target.id
                    if not (has_unit(name) or any(word in name for word in DIMENSIONLESS)):
                        bare.append(f"{path.stem}.{record.name}.{name}")
    # An effect's parameter, an interval, a jump, a drift, a noise: values of any unit, beside its name.
    own_unit = {"effect.Parameter.low", "effect.Parameter.high", "mapping.ColumnSource.start"}
    own_unit |= {"reading_errors.ReadingJump.size", "noise_spectrum._Sized.sigma"}
    own_unit |= {"drift.AllowedDrift.size", "mains_hum._Line.size"}
    own_unit |= {f"intervals.Interval.{name}" for name in ("value", "low", "high")}
    assert set(bare) <= own_unit
