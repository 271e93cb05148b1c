"""Where the axes of a picture lie."""

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from diagnosis.report.figures import layout
from diagnosis.report.figures.layout import subplots

SIZE = (6.0, 4.0)


def drawn(figure):
    """The figure, once it is drawn, and its renderer."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return canvas.get_renderer()


def boxes(figure):
    """What axes take with all their labels, pixels, in the order of the axes."""
    renderer = drawn(figure)
    return [axes.get_tightbbox(renderer) for axes in figure.axes]


def labelled(rows, columns, **settings):
    figure, grid = subplots(rows, columns, figsize=SIZE, squeeze=False, **settings)
    for i, axes in enumerate(grid.flat):
        axes.plot([0.0, 1.0], [0.0, 10.0 ** (3 - 2 * i)])
        axes.set_title(f"axes {i}", loc="left")
        axes.set(xlabel="first line\nsecond line", ylabel="height, mm")
    return figure


@pytest.mark.parametrize(("rows", "columns"), [(1, 1), (1, 3), (2, 2), (3, 1)])
def test_no_label_is_cut_off_and_none_overlaps_another(rows, columns):
    found = boxes(figure := labelled(rows, columns))
    width, height = figure.bbox.size
    for box in found:
        assert min(box.x0, box.y0, width - box.x1, height - box.y1) >= 0
    for i, one in enumerate(found):
        assert not any(one.overlaps(other) for other in found[i + 1 :])


@pytest.mark.parametrize("again", [False, True])
def test_numbers_that_show_only_on_axes_of_their_last_height_have_room(monkeypatch, again):
    if not again:
        monkeypatch.setattr(layout, "_with_numbers", lambda _, room: room)
    figure, (first, second) = subplots(1, 2, figsize=(8.0, 3.0))
    first.set_xlabel("x" + 3 * "\nx")  # axes become lower, their numbers wider
    second.plot([0.0, 1.0], [0.0, 11.0])
    second.set_ylabel("height, mm")
    left, right = boxes(figure)
    assert left.overlaps(right) is not again


def test_long_names_of_rows_push_the_axes_aside():
    left = []
    for names in (("a", "b"), ("load_dependent_friction", "tissue_viscoelasticity")):
        figure, axes = subplots(figsize=SIZE)
        axes.barh([0, 1], [1, 2])
        axes.set_yticks([0, 1], names)
        (box,) = boxes(figure)
        assert box.x0 >= 0
        left.append(axes.get_position().x0)
    assert left[1] > left[0] + 0.1


def test_names_longer_than_the_picture_leave_axes():
    figure, axes = subplots(figsize=SIZE)
    axes.barh([0], [1])
    axes.set_yticks([0], ["x" * 200])
    drawn(figure)
    assert axes.get_position().width > 0.3


def test_axes_are_of_one_size_in_spite_of_their_labels():
    figure = labelled(2, 2)
    drawn(figure)
    sizes = [axes.get_position().size for axes in figure.axes]
    np.testing.assert_allclose(sizes, [sizes[0]] * 4, rtol=1e-9)


def test_a_label_below_all_axes_has_its_room():
    figure = labelled(1, 2)
    figure.supxlabel("below all")
    lowest = min(box.y0 for box in boxes(figure))
    assert figure._supxlabel.get_window_extent().y1 <= lowest


def test_axes_that_are_not_shown_take_no_room():
    figure = labelled(1, 2)
    figure.axes[1].set_visible(False)
    figure.axes[1].set_yticks([0], ["x" * 200])
    drawn(figure)
    assert figure.axes[0].get_position().width > 0.3
