"""A page outlives its parts."""

import errno
import pickle

import pytest

from diagnosis.report.fallible import Page, drawn, page_of, section, write_page
from diagnosis.report.figures.layout import subplots
from diagnosis.report.html_parts import heading, paragraph
from models.errors import UnwritableOutput
from sim.files import Destination, publishing

WHY = "(ValueError: no <such> column)"


def draws(title):
    figure, axis = subplots(figsize=(2, 1))
    axis.set_title(title)
    return figure


def fails(*_):
    raise ValueError("no <such> column")


def describes(title):
    return f"a frame called {title}"


def test_a_picture_that_can_be_drawn_is_drawn():
    part = drawn(draws, describes, "loops")
    assert 'alt="a frame called loops"' in part
    assert page_of("page", [part]).lacks == ()


@pytest.mark.parametrize(("draw", "describe"), [(fails, describes), (draws, fails)])
def test_a_picture_that_fails_is_a_sentence(draw, describe):
    part = drawn(draw, describe, "loops")
    assert part == (
        '<p class="warning">The picture for this place could not be made (ValueError: no '
        "&lt;such&gt; column). The rest of the page is complete without it.</p>"
    )


def test_a_missing_part_of_another_process_is_missing_here():
    part = drawn(fails, describes, "loops")
    there = pickle.loads(pickle.dumps(part))
    assert there == part
    assert page_of("page", [heading("Loops"), there]).lacks == (f"the picture under 'Loops' {WHY}",)


def test_ctrl_c_is_no_failure_of_a_picture():
    def interrupted(_):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        drawn(interrupted, describes, "loops")


def test_a_page_tells_what_it_lacks_and_where():
    def rig():
        return [heading("The rig"), paragraph("a needle")]

    page = page_of(
        "page",
        [
            heading("Loops & lag"),
            drawn(fails, describes, "loops"),
            *section(fails),
            *section(rig),
        ],
    )
    assert page.lacks == (
        f"the picture under 'Loops & lag' {WHY}",
        f"the section after 'Loops & lag' {WHY}",
    )
    assert page.text.count("The rest of the page is complete without it.") == 2
    assert "<p>a needle</p>" in page.text


def test_a_section_with_the_title_leaves_a_title_when_it_fails():
    page = page_of("page", [*section(fails), *section(fails, title="Gap & report"), paragraph("rows")])
    assert page.lacks == (
        f"the section at the top {WHY}",
        f"the section after 'Gap & report' {WHY}",
    )
    assert page.text.count("<h1>Gap &amp; report</h1>") == 1
    assert "<p>rows</p>" in page.text


def test_an_error_without_words_is_named():
    def speechless(_):
        raise KeyError

    assert "could not be made (KeyError)." in drawn(speechless, describes, "loops")


def test_a_page_with_a_part_missing_is_a_result_that_lacks_something(tmp_path):
    path = tmp_path / "page.html"
    with publishing(Destination(folder=tmp_path), [path]) as results:
        write_page(lambda: Page(text="<p>", lacks=("the picture",)), results, path)
    assert path.read_text() == "<p>"
    assert (results.left_out, results.lacks) == ({}, {path: ("the picture",)})


def test_a_disk_that_is_full_is_no_failure_of_a_page(tmp_path):
    def full():
        raise OSError(errno.ENOSPC, "No space left on device")

    path = tmp_path / "page.html"
    with pytest.raises(UnwritableOutput), publishing(Destination(folder=tmp_path), [path]) as results:
        write_page(full, results, path)
