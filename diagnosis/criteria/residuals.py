"""Where the residual is (residuals/)."""

TURNING_DEG_S = 1.0
AFTER_REVERSAL_S = 2.0
STRETCH_S = 5.0
BANDS_HZ = ((0.0, 0.1), (0.1, 1.0), (1.0, 10.0), (10.0, 1000.0))
"""Parts that the residual is broken down into: turning, after a reversal, stretches, frequencies."""
ANGLE_PARTS = 12
SINCE_REVERSAL_PARTS_S = (0.0, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 100.0)
RATE_PARTS_DEG_S = (1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0)
"""Parts along the motion: of the range of the base angle, after a reversal, and of the rate, either way;
the slowest is a base that holds."""
LEAST_IN_PART = 20
"""Derived: the root mean square of fewer samples is known to no better than 16 %, 1 / sqrt(2 N)."""
LONGEST_LAG_S = 10.0
LONGEST_LEAD_S = 2.0
"""Physical: a needle relaxes within seconds. Lags of the autocorrelation, and of one sensor's residual
behind the other's."""
LEAD_SIGMA = 4.0
"""Derived: the highest of 400 independent correlations of unrelated residuals exceeds four of their
standard deviations in 2.5 of 100 logs; those of slow residuals are fewer."""
