"""The ground truth of a set of logs: reads and checks `answers/answers.json`."""

import json
from pathlib import Path
from typing import Any

from diagnosis.effects import LIBRARY
from models.errors import InvalidValue

FILE = Path("answers", "answers.json")
NEEDED = ("verdict", "effects", "parameters")
"""Keys without which an answer cannot be compared with a report."""
MISSING = ("place", "variables")
"""Keys of what is missing of a log whose effect is outside of the library."""
FIX = "restore the file, or write a new set with needle blind make"


def read_answers(folder: Path) -> dict[str, dict[str, Any]]:
    """Ground truth of every log in `folder`, by the name of the log's own folder.

    Raises:
      InvalidValue: the file is not a JSON object with an entry per log, or an entry lacks a key.
    """
    path = folder / FILE
    try:
        text = path.read_text(encoding="utf-8")
        answers = json.loads(text)
    except (OSError, ValueError, RecursionError) as error:
        empty = isinstance(error, json.JSONDecodeError) and not text.strip()
        found = "an empty file" if empty else f"no JSON ({error})"
        raise InvalidValue(str(path), found, "a JSON object with an entry per log", FIX) from error
    if not isinstance(answers, dict) or not answers:
        raise InvalidValue(str(path), answers, "a JSON object with an entry per log", FIX)
    for case, answer in answers.items():
        if not isinstance(answer, dict) or not {*NEEDED} <= {*answer}:
            raise InvalidValue(f"{path}: {case}", answer, f"an object with {', '.join(NEEDED)}", FIX)
        _refuse_other_types(f"{path}: {case}", answer)
    return answers


def _refuse_other_types(place: str, answer: dict[str, Any]) -> None:
    effects, parameters = answer["effects"], answer["parameters"]
    if not isinstance(answer["verdict"], str):
        raise InvalidValue(f"{place}.verdict", answer["verdict"], "a word", FIX)
    if not _are_words(effects):
        raise InvalidValue(f"{place}.effects", effects, "a list of names", FIX)
    if not isinstance(parameters, dict):
        raise InvalidValue(f"{place}.parameters", parameters, "an object with an entry per effect", FIX)
    for name, own in parameters.items():
        if not (isinstance(own, dict) and (name not in LIBRARY or _are_numbers(own))):
            raise InvalidValue(f"{place}.parameters.{name}", own, "an object of numbers", FIX)
    missing = answer.get("missing", {"place": [], "variables": []})
    if not (isinstance(missing, dict) and all(_are_words(missing.get(n)) for n in MISSING)):
        raise InvalidValue(f"{place}.missing", missing, f"lists of names as {', '.join(MISSING)}", FIX)
    signature = answer.get("signature", {})
    if not (isinstance(signature, dict) and _are_numbers(signature)):
        raise InvalidValue(f"{place}.signature", signature, "an object of numbers", FIX)


def _are_words(values: Any) -> bool:
    return isinstance(values, list) and all(isinstance(name, str) for name in values)


def _are_numbers(values: dict[str, Any]) -> bool:
    return all(isinstance(v, int | float) and not isinstance(v, bool) for v in values.values())
