"""Thomas' algorithm, in two parts so that factors can be used again.

The matrices here are diagonally dominant: no pivoting. Where friction weakens with the rate one may
be indefinite: its negative pivots count as positive, which makes of the solution a direction of descent.
"""

from sim.kernel.compiled import Array, inlined


@inlined
def factorise(lower: Array, diagonal: Array, upper: Array) -> bool:
    """Factors in place; returns whether the matrix is positive definite.

    `diagonal` becomes the inverse sizes of the pivots; `lower` and `upper` are times inverse pivots.
    Row i reads lower[i], diagonal[i], upper[i]; lower[0] and upper[-1] are unused.
    """
    least = diagonal[0]
    inverse = 1.0 / least
    diagonal[0] = abs(inverse)
    for i in range(1, diagonal.size):
        lower[i] *= inverse
        pivot = diagonal[i] - lower[i] * upper[i - 1]
        upper[i - 1] *= inverse
        inverse = 1.0 / pivot
        least = min(least, pivot)
        diagonal[i] = abs(inverse)
    return least > 0.0


@inlined
def substitute(lower: Array, diagonal: Array, upper: Array, rhs: Array) -> None:
    """Solve with the factors; the solution replaces `rhs`."""
    n = rhs.size
    value = rhs[0]
    for i in range(1, n):
        value = rhs[i] - lower[i] * value
        rhs[i] = value
    value *= diagonal[n - 1]
    rhs[n - 1] = value
    for i in range(n - 2, -1, -1):
        value = rhs[i] * diagonal[i] - upper[i] * value
        rhs[i] = value
