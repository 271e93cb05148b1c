"""How the optimiser of a fit ended, in its own words."""

from dataclasses import dataclass
from enum import StrEnum


class Termination(StrEnum):
    """Why a fit ended."""

    GRADIENT = "converged: gradient"
    STEP = "converged: step"
    OFFSET = "converged: relative offset"
    STALLED = "stalled: no further reduction"
    ITERATIONS = "stopped: most iterations"
    BEHIND = "stopped: cannot come near the best"
    FACTORIZATION = "failed: factorization"
    NOTHING_TO_FIT = "nothing to fit"
    OTHER = "other"


# What the messages of mujoco.minimize contain.
_WORDS = {
    "norm(gradient) < tol": Termination.GRADIENT,
    "norm(dx) < tol": Termination.STEP,
    "insufficient reduction": Termination.STALLED,
    "maximum iterations": Termination.ITERATIONS,
    "factorization failed": Termination.FACTORIZATION,
}


@dataclass(frozen=True, kw_only=True)
class FitStatus:
    """The end of a fit.

    Attributes:
      message: of the optimiser.
      at_bound: parameters that stopped at a bound, as effect.parameter.
    """

    termination: Termination
    message: str
    at_bound: tuple[str, ...] = ()

    @property
    def converged(self) -> bool:
        """Whether the optimiser met its tolerance."""
        return self.termination in (
            Termination.GRADIENT,
            Termination.STEP,
            Termination.OFFSET,
            Termination.NOTHING_TO_FIT,
        )

    @classmethod
    def of_message(cls, said: str, at_bound: tuple[str, ...] = ()) -> "FitStatus":
        """From what the optimiser printed at its end."""
        ended = next((line for line in said.splitlines() if line.startswith("Terminated")), said.strip())
        message = ended.split(" y: ")[0]
        meant = (end for words, end in _WORDS.items() if words in message)
        return cls(termination=next(meant, Termination.OTHER), message=message, at_bound=at_bound)
