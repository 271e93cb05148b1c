"""The ground truth as a file: what is wrong with it is said by name."""

import json

import pytest

from models.errors import InvalidValue
from validation.score.answers import NEEDED, read_answers

GOOD = {"verdict": "none", "effects": [], "parameters": {}}


@pytest.fixture
def written(tmp_path):
    """Writes answers.json with this text and returns the folder."""

    def write(text):
        (tmp_path / "answers").mkdir()
        (tmp_path / "answers" / "answers.json").write_text(text)
        return tmp_path

    return write


def test_an_entry_per_log_is_read(written):
    assert read_answers(written(json.dumps({"case_001": GOOD}))) == {"case_001": GOOD}


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("", "an empty file"),
        ("[]", r"found \[\]"),
        ("{}", r"found \{\}"),
        ("{", "no JSON"),
        ("3", "found 3"),
    ],
)
def test_a_file_without_entries_is_refused_with_what_was_found(written, text, found):
    with pytest.raises(InvalidValue, match=found) as error:
        read_answers(written(text))
    for part in ("answers.json", "expected a JSON object with an entry per log", "needle blind make"):
        assert part in str(error.value)


@pytest.mark.parametrize(
    "entry", [[], "none", *({k: v for k, v in GOOD.items() if k != n} for n in NEEDED)]
)
def test_an_entry_that_lacks_a_key_is_refused_by_its_name(written, entry):
    text = json.dumps({"case_001": GOOD, "case_002": entry})
    with pytest.raises(InvalidValue, match=r"answers\.json: case_002: expected an object with verdict"):
        read_answers(written(text))


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"verdict": 3}, r"case_001\.verdict"),
        ({"effects": "coulomb_friction"}, r"case_001\.effects: expected a list"),
        ({"effects": [[]]}, r"case_001\.effects: expected a list"),
        ({"parameters": []}, r"case_001\.parameters: expected an object"),
        ({"parameters": {"tip_drag": 3}}, r"case_001\.parameters\.tip_drag: expected an object"),
        ({"parameters": {"tip_drag": {"damping": "much"}}}, r"parameters\.tip_drag: .*of numbers"),
        ({"signature": {"tip_drag": None}}, r"case_001\.signature"),
        ({"missing": []}, r"case_001\.missing"),
        ({"missing": {"place": ["drive"]}}, r"case_001\.missing: expected lists of names"),
        ({"missing": {"place": "drive", "variables": []}}, r"case_001\.missing"),
    ],
)
def test_a_value_of_another_kind_is_named(written, change, said):
    with pytest.raises(InvalidValue, match=said):
        read_answers(written(json.dumps({"case_001": GOOD | change})))


def test_bytes_and_brackets_without_end_are_no_json(written):
    with pytest.raises(InvalidValue, match="no JSON"):
        read_answers(written("[" * 100_000))
