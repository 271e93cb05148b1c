"""Where the residual is (residuals/)."""

TURNING_DEG_S = 1.0
"""Rate above which the base turns; below it, it holds. A choice of what is told."""
AFTER_REVERSAL_S = 2.0
"""How long after a reversal a sample counts as after it. Physical: a needle relaxes within seconds."""
STRETCH_S = 5.0
"""Length of the stretches of which the one with the largest residual is told. A choice."""
BANDS_HZ = ((0.0, 0.1), (0.1, 1.0), (1.0, 10.0), (10.0, 1000.0))
"""Bands of the residual's spectrum: decades, the last up to any sampling rate. A choice."""
ANGLE_PARTS = 12
"""Parts of the range of the base angle. A choice."""
SINCE_REVERSAL_PARTS_S = (0.0, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 100.0)
"""Limits of the parts of the time since a reversal. A choice."""
RATE_PARTS_DEG_S = (1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0)
"""Limits of the parts of the rate, either way; below the first, the base holds. A choice."""
LEAST_IN_PART = 20
"""Derived: the root mean square of fewer samples is known to no better than 16 %, 1 / sqrt(2 N)."""
LONGEST_LAG_S = 10.0
"""Longest lag of the autocorrelation. Physical: a needle relaxes within seconds."""
LONGEST_LEAD_S = 2.0
"""Longest time by which one sensor's residual may lead the other's. Physical, as above."""
LEAD_SIGMA = 4.0
"""Derived: the highest of 400 independent correlations of unrelated residuals exceeds four of their
standard deviations in 2.5 of 100 logs; those of slow residuals are fewer."""
ONE_TRIAL_GAP, OTHER_TRIALS_GAP = 1.3, 1.1
"""Gaps of the nominal rig above which one trial is off, and up to which all others are at the noise. A
choice of what is told: 500 samples are within 1.1 in 999 of 1000 trials."""
