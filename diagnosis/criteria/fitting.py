"""The noise floor, and what a rig may be off by without a name (fitting/)."""

# Noise floor (fitting/noise_floor.py, fitting/noise_reestimation.py)

GAP_LIMIT = 1.03
"""Root mean square of residual / sigma at the noise floor. Numerical error below a tenth of sigma adds
0.005; noise of the base angle that returns as torque the rest. White residuals measured 0.98 to 1.02 on
practice logs, unexplained ones 6 and more."""
SLOW_BLOCK = 25
"""Samples of a block, whose mean tells what is slow."""
SLOW_LIMIT = 1.25
"""The same as GAP_LIMIT of means of blocks, scaled by the square root of their samples. White residuals
measured 0.95 to 1.07, unexplained ones 30 and more."""
FLOOR_SIGMA = 3.5
"""Derived: standard deviations of both under chance, which widen the limits where samples are few: one
white residual in 4000 is above."""
NOISE_TRUST = 0.08
"""Noise re-estimated from the residual may differ from the first estimate (good to 2 %) by this share;
beyond, something fast is left in the residual."""
NOISE_LEAST_WEIGHT = 0.8
"""Noise is estimated where readings have this weight at least: where a prediction is not exact, what is
left is not all noise. Derived: its error is then 0.75 sigma at most."""
NOISE_LEAST_ROWS = 200
"""If there are so many of them. Derived: the noise of so many white readings is told to 5 %."""
NOISE_HEAVY = 1.05
"""Standard deviation of noise / that of its core, from which its tails are heavy. Measured: normal noise
of 1200 samples came to 1.04 in 1 of 400."""
NOISE_HEAVIEST = 1.4
"""By which they may add to that at most. Student's t with 3 degrees of freedom, the heaviest whose
variance scatters little, comes to 1.3, with a scatter of 0.06."""

BASE_NOISE_GAP = 2.0
"""Gap up to which it is asked what of a residual above the floor the noise of the base's encoder makes.
A choice that saves time."""
BASE_NOISE_READINGS = 4
"""Simulated readings of the encoder, of which the one that changes most counts: a real one changes more
once in five logs, and the limits beside it have room for that."""
BASE_NOISE_MORE = 2.0
"""Times another one, by which one of them may change more. A choice."""

# What a rig may be off by without a name (fitting/nuisance.py)

SCATTER = {"stiffness_error": 0.015, "damping_error": 0.015}
"""One standard deviation, as a fraction, of what a rig's own constants are off by. A choice: nothing in
a log tells a true error of 3 % from an inaccurate constant."""
EXACT = 0.001
"""The same of a rig whose constants were measured well. A choice: a third of what is told of them alone
(SCATTER_LEAST), and three times what two simulations of the same rig differ by."""
SCATTER_NAMED = 2.0
"""Standard deviations of that scatter beyond which it is named beside other effects."""
SCATTER_ALIKE = 2.49
"""The same of both together, the root of the sum of squares, where both are off alike: one cause may be
behind them. As unlikely by chance as the one above (the chi-square distribution of two)."""
SLIDING_MM_S = 0.05
"""Axial speed from which the needle counts as sliding."""
