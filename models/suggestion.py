"""Which of the known names was probably meant."""

from collections.abc import Iterable
from difflib import get_close_matches
from typing import Any


def did_you_mean(found: Any, known: Iterable[Any]) -> str:
    """`did you mean 'least_time'?` of 'Least-Time'; empty where no known name resembles it."""
    plain = {_plain(name): str(name) for name in known}
    close = get_close_matches(_plain(found), plain, n=1) or _begin_with(_plain(found), plain)
    return f"did you mean {plain[close[0]]!r}?" if close else ""


def _begin_with(found: str, names: Iterable[str]) -> list[str]:
    """The only name that begins with what was found: a field without its unit, say."""
    longer = [name for name in names if found and name.startswith(f"{found}_")]
    return longer if len(longer) == 1 else []


def _plain(name: Any) -> str:
    return str(name).lower().replace("-", "_")
