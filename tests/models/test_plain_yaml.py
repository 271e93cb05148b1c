"""YAML files are plain values, and what is more or less is refused with its line."""

import time

import pytest

from models.errors import InvalidValue
from models.plain_yaml import MOST_BYTES, MOST_LEVELS, read_record, read_yaml
from models.record import Record

_ENDLESS_S = 20.0  # what is refused at once on any machine, however busy, and what would never end


class Place(Record):
    x_mm: float
    there: bool = True
    more: tuple["Place", ...] = ()
    inner: "Place | None" = None


def read(folder, content):
    path = folder / "file.yaml"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return read_yaml(path, expected="a mapping of fields")


def refusal(folder, content):
    with pytest.raises(InvalidValue) as caught:
        read(folder, content)
    assert "file.yaml" in str(caught.value)
    return str(caught.value)


def test_plain_values_are_read_as_they_stand(tmp_path):
    text = "name: Nädel 針\nnumbers: [1, 2.5, .nan]\nnested: {a: {b: no}}\n"
    found = read(tmp_path, text)
    assert found["name"] == "Nädel 針"
    assert found["numbers"][:2] == [1, 2.5]
    assert found["nested"] == {"a": {"b": False}}


@pytest.mark.parametrize("change", [lambda t: "\ufeff" + t, lambda t: t.replace("\n", "\r\n")])
def test_a_byte_order_mark_and_other_line_ends_change_nothing(tmp_path, change):
    text = "a: 1\nb: [two, 3]\n"
    assert read(tmp_path, change(text)) == read(tmp_path, text)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("a: 1\n1: 2\n", "line 2: expected the name of a field .*found '1'"),
        ("null: 2\n", "line 1: expected the name of a field"),
        ("? [a, b]\n: 2\n", "line 1: expected the name of a field .*a collection"),
        ("yes: 2\n", "line 1: expected the name of a field"),
        ("b:\n  c: {d: 1, 2: 3}\n", "line 2: expected the name of a field .*found '2'"),
        ("b: [{c: 1, c: 2}]\n", "line 1: expected each name once, not twice, found 'c'"),
        (
            "a: !!timestamp 2020-99-99\n",
            "line 1: expected readable YAML, found 'not a valid timestamp: 2020-99-99'",
        ),
        ('a: 1\nb: !!int ""\n', "line 2: .*not a valid int:"),
        ('a: !!bool "x"\n', "not a valid bool: x"),
        ('a: !!float ""\n', "not a valid float:"),
        ("a: 2020-99-99\n", "not a valid timestamp: 2020-99-99"),
        ("a: !!binary x\n", "line 1"),
        ("a: !!python/name:os.system\n", "readable YAML"),
        ("a: &x 1\nb: *x\n", "line 1: expected plain values.*found 'x'"),
        ("a: " + "[" * 1000 + "]" * 1000, f"at most {MOST_LEVELS} levels"),
        ("a: " + "[" * 500_000, f"at most {MOST_LEVELS} levels"),
        ("a: " + "x" * MOST_BYTES, f"at most {MOST_BYTES} bytes"),
        ("a: 1\nb: caf\xe9\n".encode("latin-1"), "line 2: expected text in UTF-8"),
        ("a: 1\n".encode("utf-16"), "line 1: expected text in UTF-8"),
        ('a: "\\e[31mred"\n', r"line 1: expected text without control characters, found '\\x1b'"),
        ('a: ["\\0"]\n', "control characters"),
        ('"a\\eb": 1\n', "the name of a field"),
        (b"a: \x00\n", "readable YAML"),
        ("", "expected a mapping of fields, found 'an empty file'"),
        ("# only a comment\n", "an empty file"),
        ("- a\n", r"expected a mapping of fields, found \['a'\]"),
        ("a: 1\n---\nb: 2\n", "readable YAML"),
        ("a: [1\n", "line 2: expected readable YAML"),
    ],
)
def test_what_is_more_or_less_is_refused_with_its_line(tmp_path, content, said):
    message = refusal(tmp_path, content)
    with pytest.raises(InvalidValue, match=rf"(?s){said}"):
        read(tmp_path, content)
    assert len(message) < 1500


def test_a_bomb_of_twelve_levels_of_nine_aliases_is_refused_at_once(tmp_path):
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]" for i in range(1, 12)]
    start = time.process_time()
    assert "alias" in refusal(tmp_path, "\n".join([*lines, "name: *a11"]))
    assert time.process_time() - start < _ENDLESS_S


def test_a_folder_and_a_missing_file_are_named(tmp_path):
    for path in (tmp_path, tmp_path / "none.yaml", tmp_path / ("x" * 300), tmp_path / "a\0b"):
        with pytest.raises(InvalidValue, match="expected a mapping of fields"):
            read_yaml(path, expected="a mapping of fields")


def test_a_record_of_a_file_names_file_and_field(tmp_path):
    path = tmp_path / "file.yaml"
    assert read_record(path, Place, {"x_mm": 1}) == Place(x_mm=1)
    with pytest.raises(InvalidValue, match=r"file\.yaml: x_mm: expected a finite number, found nan"):
        read_record(path, Place, {"x_mm": float("nan")})
    with pytest.raises(InvalidValue, match=r"file\.yaml: inner\.x_mm"):
        read_record(path, Place, {"x_mm": 1, "inner": {"x_mm": "far"}})
    with pytest.raises(InvalidValue, match=r"file\.yaml: self"):
        read_record(path, Place, {"x_mm": 1, "self": 2})


def test_a_truth_is_no_number(tmp_path):
    path = tmp_path / "file.yaml"
    assert read_record(path, Place, {"x_mm": 1, "there": False}) == Place(x_mm=1, there=False)
    for content, field in [
        ({"x_mm": True}, "x_mm"),
        ({"x_mm": 1, "inner": {"x_mm": False}}, "inner.x_mm"),
        ({"x_mm": 1, "more": [{"x_mm": 1}, {"x_mm": True}]}, "more.1.x_mm"),
    ]:
        with pytest.raises(InvalidValue, match=rf"file\.yaml: {field}: expected a number, found"):
            read_record(path, Place, content)
