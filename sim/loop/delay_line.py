"""A delay of whole samples.

A delay of 2 samples, as values go in at one end and come out at the other:

    sample      0  1  2  3  4  5
    in          a  b  c  d  e  f
    out         a  a  a  b  c  d

Until the first value has passed, it is repeated; or another value comes out before it (a drive
that has received no command yet is at 0):

    out         0  0  a  b  c  d        with first=0
"""

from collections import deque

from models.errors import InvalidValue


class DelayLine:
    """Returns each value some samples later; see the module.

    Args:
      delay_s: rounded to whole samples.
      sample_s: sampling interval.
      first: output before the first value has passed; None: the first value.

    Raises:
      InvalidValue: the delay is negative or not finite.
    """

    def __init__(self, delay_s: float, sample_s: float, *, first: float | None = None) -> None:
        if not 0 <= delay_s < float("inf"):
            raise InvalidValue("delay_s", delay_s, "a finite time of at least 0 s")
        self.samples = round(delay_s / sample_s)
        self._held = deque([] if first is None else [first] * self.samples)

    def __call__(self, value: float) -> float:
        """Store the value of this sample; return that of `samples` earlier."""
        self._held.append(value)
        while len(self._held) <= self.samples:
            self._held.append(value)
        return self._held.popleft()
