"""How `make docs` builds the site with Sphinx: nothing in it comes from a network."""

import re
import sys
from pathlib import Path

from pygments.lexers.special import TextLexer
from sphinx.application import Sphinx

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]

from commands import commands_page  # noqa: E402 - beside this file

from models.record import Record  # noqa: E402
from scripts.arguments import parser  # noqa: E402

project = "needle-torsion"
copyright = "2026 The needle-torsion authors"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
html_theme = "furo"
html_title = project
html_show_sphinx = False
html_copy_source = False
html_static_path = ["_static"]
html_css_files = ["site.css"]
smartquotes = False  # two hyphens begin an option
myst_heading_anchors = 4
default_role = "code"  # docstrings mark code as Markdown does
autodoc_member_order = "bysource"
autodoc_typehints_format = "short"
python_maximum_signature_line_length = 90
napoleon_use_ivar = True

_OUTSIDE = re.compile(r"\[([^\]]+)\]\((?:\.\./)+((?!docs)[^)#]+)(?:#[^)]*)?\)")


def _outside(found: re.Match[str]) -> str:
    """A link to a file of the repository that is no page: its path, which a site cannot show."""
    text, path = found[1].strip("`"), found[2]
    return f"`{path}`" if text in (path, f"docs/{path}") else f"{found[1]} (`{path}`)"


def prepare_page(app: Sphinx, name: str, content: list[str]) -> None:
    """A page before it is read: with all commands where they belong, without links to elsewhere."""
    text = content[0].replace("<!-- commands -->", commands_page(parser()))
    inside = HERE / Path(name).parent
    content[0] = _OUTSIDE.sub(
        lambda found: found[0] if _is_page(inside, found[0]) else _outside(found), text
    )


def _is_page(folder: Path, link: str) -> bool:
    target = (folder / link.rpartition("(")[2].rstrip(")").partition("#")[0]).resolve()
    return target.is_relative_to(HERE)


def name_fields(
    app: Sphinx, what: str, name: str, of: object, options: object, signature: str, returns: str
) -> tuple[str, str] | None:
    """Records by the names of their fields, which say the units; what is left out has a default."""
    if not (isinstance(of, type) and issubclass(of, Record)):
        return None
    fields = [n if field.is_required() else f"{n}=..." for n, field in of.model_fields.items()]
    return f"(*, {', '.join(fields)})", ""


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.connect("autodoc-process-signature", name_fields)
    app.connect("source-read", prepare_page)
    app.add_lexer("csv", TextLexer)
