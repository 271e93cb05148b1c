"""The methods of a step, by their order: singly diagonally implicit Runge-Kutta.

All are L-stable and stiffly accurate, with as many stages as their order is:

    1  backward Euler, which MuJoCo's `discrete` integrator does
    2, 3  Alexander, SIAM J. Numer. Anal. 14 (1977): gamma is the root of
          g^2 - 2 g + 1/2 and of g^3 - 3 g^2 + 3 g / 2 - 1 / 6 that lies between 0 and 1/2

A stage of length gamma h leads from y* to y; the first starts from y0. The next starts from

    y0 + kept (y* - y0) + carried (y - y*),

so that a step remembers nothing but its start and its last stage.
"""

import numpy as np

GAMMAS = (1.0, 1.0 - 0.5**0.5, 0.43586652150845899942)  # by order - 1

_G2, _G3 = GAMMAS[1:]
_B1 = -1.5 * _G3**2 + 4.0 * _G3 - 0.25
_B2 = 1.5 * _G3**2 - 5.0 * _G3 + 1.25
_A = 0.5 * (1.0 - _G3)

# What a stage is of its step: where it ends, and its share in the mean over the step.
# And how the next one starts.
REACH, SHARE, KEPT, CARRIED = range(4)
STAGES = np.array(
    [
        [[1.0, 1.0, 0.0, 0.0], [0.0] * 4, [0.0] * 4],
        [[_G2, 1.0 - _G2, 0.0, 1.0 / _G2 - 1.0], [1.0, _G2, 0.0, 0.0], [0.0] * 4],
        [
            [_G3, _B1, 0.0, _A / _G3],
            [0.5 * (1.0 + _G3), _B2, _B1 / _A, _B2 / _G3],
            [1.0, _G3, 0.0, 0.0],
        ],
    ]
)
"""(order - 1, stage, column)."""
