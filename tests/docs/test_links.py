"""Every link, module path and criterion that the documentation names exists."""

import re
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from pkgutil import iter_modules

import pytest

import diagnosis.criteria

ROOT = Path(__file__).parents[2]
FIRST = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")]
PAGES = [*FIRST, *sorted((ROOT / "docs").rglob("*.md"))]
PACKAGES = "models|sim|controllers|diagnosis|studies|validation|scripts|benchmarks"
CRITERIA = {
    name
    for module in iter_modules(diagnosis.criteria.__path__, "diagnosis.criteria.")
    for name in vars(import_module(module.name))
}
NAMES = [page.relative_to(ROOT).as_posix() for page in PAGES]


def links(text):
    """Targets of relative links and pictures."""
    return [to for to in re.findall(r"\]\(([^)\s]+)\)", text) if "://" not in to]


def anchor_of(heading):
    """As GitHub makes it: lower case, no punctuation, hyphens for blanks."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def anchors(page):
    text = re.sub(r"```.*?```", "", page.read_text(), flags=re.DOTALL)
    return {anchor_of(heading) for heading in re.findall(r"^#+ (.+)$", text, flags=re.MULTILINE)}


def marked(text):
    """Everything in code marks, outside of code blocks."""
    return re.findall(r"`([^`\n]+)`", re.sub(r"```.*?```", "", text, flags=re.DOTALL))


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_every_relative_link_leads_to_a_file_and_to_a_heading_in_it(page):
    for link in links(page.read_text()):
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        assert target.exists(), link
        assert not anchor or anchor in anchors(target), link


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_every_path_that_a_page_names_exists(page):
    paths = [m for m in marked(page.read_text()) if re.match(rf"({PACKAGES}|tests|docs|examples)/", m)]
    assert [path for path in paths if not (ROOT / path.partition("::")[0]).exists()] == []


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_every_module_that_a_page_names_exists(page):
    text, dotted = page.read_text(), rf"(?:{PACKAGES})(?:\.[a-z_]+)+"
    names = [m for m in marked(text) if re.fullmatch(dotted, m)]
    names += re.findall(rf"python -m ({dotted})", text) + re.findall(rf"from ({dotted}) import", text)
    assert [name for name in names if find_spec(name) is None] == []


def test_every_criterion_that_the_method_and_its_decisions_name_exists():
    for name in ("diagnosis", "decisions", "rig-log", "accuracy", "gap-report", "effects"):
        capitals = [
            m
            for m in marked((ROOT / "docs" / f"{name}.md").read_text())
            if re.fullmatch(r"[A-Z]{2,}(_[A-Z]+)*", m)
        ]
        assert [c for c in capitals if c not in CRITERIA] == [], name


def test_every_page_is_reached_from_the_readme_or_the_first_page_of_the_site():
    """The site is told in `make docs` where each page stands: the build fails where one is missing."""
    readme, index = ((ROOT / name).read_text() for name in ("README.md", "docs/index.md"))
    pages = [page.relative_to(ROOT / "docs").as_posix() for page in PAGES[len(FIRST) :]]
    assert "(docs/index.md)" in readme
    missing = [p for p in pages if f"(docs/{p})" not in readme and f"({p})" not in index]
    assert missing == []
