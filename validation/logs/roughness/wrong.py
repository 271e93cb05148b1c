"""Faults of the recording, worse than roughness: a wrong clock, a wrong sign in one trial.

No effect of the library explains them, and no lab would consider them normal.
"""

from collections.abc import Callable

from numpy.random import Generator

from validation.logs.motions import LEAST_TRIALS
from validation.logs.roughness.roughness import Columns, Roughness
from validation.logs.roughness.timing import sensor_clock
from validation.logs.sensors import MEASURED, TIP, TORQUE, LogSensors

CLOCK_ERROR = (0.03, 0.1)


def wrong_clock(rng: Generator) -> Roughness:
    """The clock of tip, of torque or of both is off by 3 to 10 % against the base's encoder."""
    which = ((TIP,), (TORQUE,), (TIP, TORQUE))[int(rng.integers(3))]
    return sensor_clock(rng, *CLOCK_ERROR, which, name="wrong_clock")


def flipped_sign(rng: Generator) -> Roughness:
    """Tip or torque has the other sign in one trial."""
    column, chosen = str(rng.choice(MEASURED)), int(rng.integers(LEAST_TRIALS))

    def columns(_: Generator, __: LogSensors, trials: list[Columns]) -> list[Columns]:
        flipped = trials[chosen] | {column: -trials[chosen][column]}
        return [*trials[:chosen], flipped, *trials[chosen + 1 :]]

    numbers = {"column": column, "trial": f"trial_{chosen + 1:02d}.csv"}
    return Roughness(name="flipped_sign", numbers=numbers, columns=columns)


FAULTS: dict[str, Callable[[Generator], Roughness]] = {
    "wrong_clock": wrong_clock,
    "flipped_sign": flipped_sign,
}
