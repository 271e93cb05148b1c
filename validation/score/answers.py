"""The ground truth that a set of logs comes with: `answers/answers.json`, read and checked."""

import json
from pathlib import Path
from typing import Any

from models.errors import InvalidValue

FILE = Path("answers", "answers.json")
NEEDED = ("verdict", "effects", "parameters")
"""Keys without which an answer cannot be compared with a report."""
FIX = "restore the file, or write a new set with needle blind make"


def read_answers(folder: Path) -> dict[str, dict[str, Any]]:
    """Ground truth of every log in `folder`, by the name of the log's own folder.

    Raises:
      InvalidValue: the file is no JSON object with an entry per log, or an entry lacks a key.
    """
    path = folder / FILE
    text = path.read_text(encoding="utf-8")
    try:
        answers = json.loads(text)
    except json.JSONDecodeError as error:
        found = f"no JSON ({error})" if text.strip() else "an empty file"
        raise InvalidValue(str(path), found, "a JSON object with an entry per log", FIX) from error
    if not isinstance(answers, dict) or not answers:
        raise InvalidValue(str(path), answers, "a JSON object with an entry per log", FIX)
    for case, answer in answers.items():
        if not isinstance(answer, dict) or not {*NEEDED} <= {*answer}:
            raise InvalidValue(f"{path}: {case}", answer, f"an object with {', '.join(NEEDED)}", FIX)
    return answers
