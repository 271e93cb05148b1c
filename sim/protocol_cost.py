"""The cost of a protocol's run, checked before anything is computed or allocated."""

from collections.abc import Sequence
from typing import Protocol as Shape

from models.errors import InvalidValue
from sim.discretisation import Discretisation
from sim.kernel import memory_map

MOST_BYTES = 4e9
"""Physical: what a run records is kept in memory until it is written; machines of labs have 8 GB."""
MOST_SAMPLES = 1_000_000
"""Physical: of the inputs, as numbers of Python: a quarter of a gigabyte."""
STEPS_A_WAVE = 4.0
"""Derived: with fewer, linear inputs between the ends of steps lose a third of a wave's size."""
SAMPLES_A_WAVE = 32
_JUMP = 1e-6  # of a segment, that a jump at its start takes


class _Timed(Shape):
    """The fields of a segment that decide its cost."""

    @property
    def duration_s(self) -> float: ...

    @property
    def dither_hz(self) -> float: ...


def samples_of(segment: _Timed) -> float:
    """Samples of the inputs in a segment: its two ends, or many per period of its dither."""
    waves = segment.dither_hz * segment.duration_s
    return 2.0 if waves == 0 else waves * SAMPLES_A_WAVE + 1.0


def recorded_bytes(steps: float, elements: int, rows: int) -> float:
    """Memory that a run's recording takes, bytes; `rows`: of the law table."""
    return 8.0 * steps * (memory_map.userdata(elements, rows) + elements + memory_map.OUTPUTS)


def refuse_costly(
    segments: Sequence[_Timed], discretisation: Discretisation, *, layers: int, rows: int
) -> None:
    """Check the cost of a run, and that its inputs can be sampled.

    Args:
      layers: number of layers of the tissue; rows: number of rows of the law table.

    Raises:
      InvalidValue: names the field, what the run would cost, and how to make it cheaper.
    """
    step_s, time_s = discretisation.step_s, 0.0
    for i, segment in enumerate(segments):
        if not time_s < time_s + _JUMP * segment.duration_s < time_s + segment.duration_s:
            expected = f"a time that can be told from {time_s:g} s, when the segment starts"
            raise InvalidValue(f"segments.{i}.duration_s", segment.duration_s, expected)
        if segment.dither_hz * step_s > 1 / STEPS_A_WAVE:
            raise InvalidValue(
                f"segments.{i}.dither_hz",
                segment.dither_hz,
                f"at most {1 / (STEPS_A_WAVE * step_s):g} Hz: {STEPS_A_WAVE:g} steps per period",
                "take a shorter discretisation.step_s",
            )
        time_s += segment.duration_s
    longest = max(range(len(segments)), key=lambda i: segments[i].duration_s)
    elements = max(discretisation.elements, 2 * layers) + (discretisation.free_elements or 1)
    size = recorded_bytes(time_s / step_s, elements, rows)
    if size > MOST_BYTES:
        raise InvalidValue(
            f"segments.{longest}.duration_s",
            segments[longest].duration_s,
            f"a run that records at most {MOST_BYTES / 1e9:g} GB; "
            f"{time_s / step_s:.3g} steps of {step_s:g} s would record {size / 1e9:.3g} GB",
            "take shorter segments, a longer discretisation.step_s, fewer elements or layers",
        )
    count = [samples_of(segment) for segment in segments]
    if sum(count) > MOST_SAMPLES:
        most = max(range(len(count)), key=lambda i: count[i])
        raise InvalidValue(
            f"segments.{most}.dither_hz",
            segments[most].dither_hz,
            f"at most {MOST_SAMPLES} samples of the inputs, not {sum(count):.3g}",
            "take fewer waves, or a protocol for each part",
        )
