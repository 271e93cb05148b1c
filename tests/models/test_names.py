"""Names that become files: any language, but no paths and nothing that no file system takes."""

import pytest

from models.errors import InvalidValue
from models.names import MOST_BYTES, is_file, is_folder, refuse_no_file_name


@pytest.mark.parametrize(
    "name", ["fig4-10cm", "Nädel 針 #2", "run_$5_[x]", ".hidden", "a..b", "x" * 200]
)
def test_a_name_of_any_language_is_one(name):
    refuse_no_file_name("name", name)


@pytest.mark.parametrize(
    ("name", "fix"),
    [
        ("", "letters"),
        (" ", "letters"),
        (".", "letters"),
        ("..", "letters"),
        ("../up", "slashes"),
        ("a/b", "slashes"),
        ("a\\b", "slashes"),
        ("a\0b", "control"),
        ("a\x1bb", "control"),
        ("a\nb", "control"),
        ("\ud800", "control"),
        ("x" * (MOST_BYTES + 1), "shorten"),
        ("針" * (MOST_BYTES // 3 + 1), "shorten"),
    ],
)
def test_what_no_file_may_be_called_is_refused_with_a_way_out(name, fix):
    with pytest.raises(InvalidValue, match=rf"^segment: .*{fix}"):
        refuse_no_file_name("segment", name)


def test_what_no_file_system_can_have_is_not_there(tmp_path):
    assert is_folder(tmp_path)
    assert not is_file(tmp_path)
    for name in ("x" * 300, "a\0b", "none"):
        assert not is_file(tmp_path / name)
        assert not is_folder(tmp_path / name)
