"""Calls from a frame that is large: a compiler that calls functions deep down runs twice as fast.

Python keeps the frames of calls in chunks of 16 KiB. A call that crosses the border of a chunk gets a
new one from the system and gives it back when it returns, which costs more than most functions do. Numba
copies its intermediate code by millions of calls at one depth; where that is the border, they take two
fifths of the time of compiling. A frame that does not fit gets a larger chunk of its own, of a power of
two, and the calls below it have what it leaves.
"""

from collections.abc import Callable
from typing import TypeVar

Result = TypeVar("Result")

FRAME_WORDS = 1 << 16
"""Words of a frame of 0.5 MiB: with what else is in it, it just does not fit a chunk of that size, and
leaves as much free in one of twice that."""


def with_large_frame(function: Callable[[], Result]) -> Result:
    """What a function returns that is called from a large frame."""
    return function()


with_large_frame.__code__ = with_large_frame.__code__.replace(co_stacksize=FRAME_WORDS)
