"""Where the axes of a picture lie: each has room for its title, numbers and labels.

Only what stands around axes is measured. Matplotlib's own layouts also look at what is inside, and
solve for more than a grid needs, which takes as long as the drawing.
"""

from collections.abc import Iterable
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import LayoutEngine
from matplotlib.transforms import Bbox

_PAD = 0.07  # inches, to the edge of the picture and between neighbours
_MOST = 0.6  # of a picture, for the names of its rows: longer ones are cut off
_BELOW = 0.2  # inches, of a label below all axes

_Room = tuple[tuple[float, float], tuple[float, float]]
"""What is taken around axes, inches: left and right, above and below."""

_USUAL: _Room = (0.6, 0.1), (0.25, 0.45)


def subplots(
    rows: int = 1, columns: int = 1, *, figsize: tuple[float, float], **settings: Any
) -> tuple[Figure, Any]:
    """A figure with a grid of axes, and these as `matplotlib.figure.Figure.subplots` gives them.

    Args:
      figsize: width and height, inches.
      settings: of `Figure.subplots`.
    """
    figure = Figure(figsize=figsize, layout=_RoomForLabels())
    return figure, figure.subplots(rows, columns, **settings)


class _RoomForLabels(LayoutEngine):
    """Margins of a grid of axes that hold what stands around each."""

    _adjust_compatible = True
    _colorbar_gridspec = True

    def execute(self, fig: Figure) -> None:
        """Place the axes; matplotlib calls this before it draws."""
        shown = [axes for axes in fig.axes if axes.get_visible()]
        _place(fig, [(axes, _USUAL) for axes in shown])
        taken = [(axes, _taken(axes)) for axes in shown]
        _place(fig, taken)
        _place(fig, [(axes, _with_numbers(axes, room)) for axes, room in taken])


def _taken(axes: Axes) -> _Room:
    """By title, numbers and labels of axes."""
    figure: Any = axes.get_figure()
    renderer, frame = figure.canvas.get_renderer(), axes.bbox
    around = axes.get_tightbbox(renderer, bbox_extra_artists=[], for_layout_only=True) or frame
    whole = Bbox.union([around, frame])
    left, right = frame.x0 - whole.x0, whole.x1 - frame.x1
    above, below = whole.y1 - frame.y1, frame.y0 - whole.y0
    return (left / figure.dpi, right / figure.dpi), (above / figure.dpi, below / figure.dpi)


def _with_numbers(axes: Axes, room: _Room) -> _Room:
    """With more on the left if axes of their last height show wider numbers."""
    figure: Any = axes.get_figure()
    box = axes.yaxis.get_tightbbox(figure.canvas.get_renderer()) or axes.bbox
    (left, right), down = room
    return (max(left, (axes.bbox.x0 - box.x0) / figure.dpi), right), down


def _place(figure: Figure, shown: Iterable[tuple[Axes, _Room]]) -> None:
    """Place axes of one grid, so that each has its room."""
    places = [(place, room) for axes, room in shown if (place := axes.get_subplotspec())]
    grid: Any = places[0][0].get_gridspec()
    width, height = figure.get_size_inches()
    lowest = _BELOW if figure.get_supxlabel() else 0.0
    columns = [(place.colspan.start, *across) for place, (across, _) in places]
    rows = [(place.rowspan.start, *down) for place, (_, down) in places]
    left, right, between = _margins(columns, grid.ncols)
    top, bottom, below = _margins(rows, grid.nrows)
    left, bottom = min(left, _MOST * width), bottom + lowest
    figure.subplots_adjust(
        left=left / width,
        right=1 - right / width,
        wspace=_share(between, width - left - right, grid.ncols),
        top=1 - top / height,
        bottom=bottom / height,
        hspace=_share(below, height - top - bottom, grid.nrows),
    )


def _margins(taken: Iterable[tuple[int, float, float]], count: int) -> tuple[float, float, float]:
    """Before the first of several in line, after the last, and between two of them, inches.

    Args:
      taken: place in line, and what is taken before and after it.
    """
    before, after = [0.0] * count, [0.0] * count
    for i, own_before, own_after in taken:
        before[i], after[i] = max(before[i], own_before), max(after[i], own_after)
    between = max((a + b for a, b in zip(after[:-1], before[1:], strict=True)), default=0.0)
    return before[0] + _PAD, after[-1] + _PAD, between + _PAD


def _share(between: float, inside: float, count: int) -> float:
    """What lies between two of several in line, as a share of the mean size of one."""
    gaps = min(between * (count - 1), _MOST * inside)
    return gaps / max(count - 1, 1) / ((inside - gaps) / count)
