"""Calls from a large frame."""

import sys

import pytest

from sim.kernel.native.large_frame import FRAME_WORDS, with_large_frame


def test_the_function_is_called_from_a_frame_that_is_larger_than_any_chunk_of_frames():
    def stack_words():
        return sys._getframe(1).f_code.co_stacksize

    assert with_large_frame(stack_words) == FRAME_WORDS
    assert 8 * FRAME_WORDS > 16 * 1024


def test_what_the_function_raises_passes():
    with pytest.raises(ZeroDivisionError):
        with_large_frame(lambda: 1 // 0)
