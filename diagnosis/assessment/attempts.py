"""Attempts at what is told beside a verdict, which stands where they fail."""

from collections.abc import Callable
from typing import TypeVar

from sim.needles.run import SimulationFailed

T = TypeVar("T")


class Attempts:
    """What is told beside a verdict, which stands where that cannot be simulated.

    Attributes:
      warnings: what could not be, and why.
    """

    def __init__(self) -> None:
        self.warnings: list[str] = []

    def or_else(self, what: str, make: Callable[[], T], otherwise: T) -> T:
        """What `make` returns, or something else and a warning where that cannot be simulated."""
        try:
            return make()
        except SimulationFailed as error:
            self.warnings.append(f"{what}: could not be simulated ({error})")
            return otherwise
