"""Answers of a set of logs, and arguments of the command that are wrong in one place at least."""

import contextlib
import io
import json
import os
import tempfile
from pathlib import Path

from fuzz.mutations import NUMBERS, TEXTS, cells, changed_bytes
from fuzz.outcome import outcome
from hypothesis import strategies as st

from models.errors import NeedleError
from scripts.main import main
from validation.score.answers import read_answers

ANSWERS = {
    "case_001": {
        "verdict": "explained",
        "effects": ["tip_drag"],
        "parameters": {"tip_drag": {"damping": 0.3}},
        "signature": {"tip_drag": 4.0},
    },
    "case_002": {"verdict": "none", "effects": [], "parameters": {}},
}
json_values = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=6),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=6), inner, max_size=3),
    max_leaves=6,
)


@st.composite
def _changed_answers(draw):
    answers = json.loads(json.dumps(ANSWERS))
    case = draw(st.sampled_from(list(answers)))
    key = draw(st.sampled_from([*answers[case], "extra"]))
    if draw(st.booleans()):
        answers[case][key] = draw(json_values)
    elif draw(st.booleans()):
        answers[case].pop(key, None)
    else:
        answers[case] = draw(json_values)
    return json.dumps(answers).encode()


answers = st.one_of(
    _changed_answers(),
    changed_bytes(json.dumps(ANSWERS, indent=1).encode()),
    st.sampled_from([b"", b"[]", b"{}", b"3", b"[" * 50_000, b"\xff\xfe", b"null", b'{"a": 1e999}']),
    json_values.map(lambda value: json.dumps(value).encode()),
)


def checked_answers(data):
    """Outcome of a ground truth."""

    def action():
        with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:
            path = Path(folder, "answers", "answers.json")
            path.parent.mkdir()
            path.write_bytes(data)
            read_answers(Path(folder))
        return []

    return outcome(action, names=["answers.json"], same=False)


_plain = st.sampled_from([text for text in (*TEXTS, *NUMBERS) if "\0" not in text]) | cells.filter(
    lambda text: "\0" not in text and not any("\ud800" <= c <= "\udfff" for c in text)
)
_paths = st.sampled_from(
    ["", "x", "none/at/all", "../none", "n" * 300, "a\x1b[31m", "[/x]", "$5$", "/", "~"]
)
_numbers = st.sampled_from(["nan", "-1", "0", "-inf", "1e400", "x", "", "-1e-300", "1,5"])
_counts = st.sampled_from(["-3", "0", "1000000000", "1e9", "x", "", "1.5", "nan"])


def _command(*parts):
    return st.tuples(*(st.just(part) if isinstance(part, str) else part for part in parts)).map(list)


arguments = st.one_of(
    _command("insert", "--protocol", _plain.map("./none/{}".format)),
    _command("insert", "--protocol", _paths.filter(bool).map("no{}.yaml".format)),
    _command("insert", "--controller", _plain, "--out", "out"),
    _command("insert", "--model", _paths, "--mjcf", _paths),
    _command("replay", _paths),
    _command("diagnose", _paths),
    _command("diagnose", "none", "--limit", _numbers),
    _command("diagnose", "none", "--paper"),
    _command("inspect", _paths, "--table"),
    _command("import", _paths, _paths),
    _command("import", _paths, "--map", _paths),
    _command("blind", "make", "--out", "set", "--count", _counts),
    _command("blind", "make", "--out", "set", "--seed", st.sampled_from(["-1", "x", "1" * 40, ""])),
    _command("blind", "make", "--out", "set", "--signature", _numbers, _numbers),
    _command("blind", "make", "--out", "set", "--kinds", _plain),
    _command("blind", "make", "--out", "set", "--effects", _plain),
    _command("blind", "score", _paths, "--trials", _counts),
    _command("blind", "score", _paths, "--limit", _numbers),
    _command(_plain),
    st.lists(_plain, min_size=1, max_size=4).map(lambda rest: ["replay", "none", *rest]),
)


def checked_command(words):
    """Outcome of arguments: exit code 2 and a reason on stderr, and not a file."""

    def action():
        said, here = io.StringIO(), os.getcwd()
        with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:
            os.chdir(folder)
            try:
                with contextlib.redirect_stderr(said), contextlib.redirect_stdout(said):
                    code = main(words)
            except SystemExit as end:
                code = end.code
            finally:
                os.chdir(here)
            assert not os.listdir(folder), os.listdir(folder)
        if code == 2 and said.getvalue().startswith(("usage: ", "needle ")):
            raise NeedleError(f"expected: {said.getvalue()}")
        asked = code == 0 and {"-h", "--help"} & {*words}
        assert asked, f"exit code {code}: {said.getvalue()}"
        return []

    return outcome(action, names=[], same=False)
