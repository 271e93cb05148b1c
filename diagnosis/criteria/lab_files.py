"""Importing a lab's files (lab_files/)."""

REST_LEAST_S = 0.3
REST_RATE_SIGMA = 4.0
REST_RATE_SHARE = 0.002
"""The base rests where a line through its readings in a window of 0.3 s slopes by less than four of its
standard deviations (derived: once in 16 000 windows by chance), one step of the encoder in the window,
or this share of the fastest turn, for at least so long."""
REVERSAL_SHARE = 0.05
"""Turn back, of the whole turn, that is a reversal: what is smaller is dither."""
PLATEAU = (0.75, 0.95)
FIRST_QUARTERS, LAST_QUARTERS = (0.1, 0.3), (0.7, 0.9)
BRANCH_LEAST_NOISE = 10.0
"""Definitions. Loops of torque over angle: shares of a turn over which torque is taken for level, shares
of the way from level to level over which lines are fitted, least change of torque in its noise."""
SIGN_LEAST_WORK = 0.1
SIGN_LEAST_CORRELATION = 0.3
"""Share of the moved work, and correlation, below which a sign or an offset is not guessed."""
TIP_LEAST_CORRELATION = 0.7
"""Correlation with the base's angle from which a column is told as one that may be the tip's. Measured:
0.73 to 1.00 in the trials of examples/rig-log and examples/rig-log-dry; it fills a comment of a draft
alone."""
ZERO_SIGMA = 4.0
"""Derived: a mean at rest that is off 0 by fewer of its standard deviations reads 0."""
CLOCK_LONGEST_S = 5.0
CLOCK_STEP_S = 0.01
CLOCK_BLOCKS = 8
CLOCK_SIGMA = 4.0
CLOCK_LEAST_S = 0.1
CLOCK_LEAST_CORRELATION = 0.7
TIP_LAG_AT_MOST_S = 2.0
ALIKE_PEAKS = 0.9
"""Offsets of clocks that are looked for, their step, the blocks of which one is left out at a time, the
standard deviations and the seconds from which an offset is one (a needle is not one spring), the least
correlation that is believed, the lag up to which the tip may be slow by itself, and the share of the
highest product from which another one is about as high: of these the smallest offset is taken."""
DERIVATIVE_WINDOW_S = 0.1
"""Time over which a speed is taken from a position: 5 Hz and slower pass."""
NAME_LEAST_SCORE = 2.0
"""Weight of a name from which a column is proposed: one word of the quantity. Set on the names in
tests/diagnosis/lab_files/guesses/test_names.py; it fills a draft alone."""
MOST_BACKWARDS = 0.02
"""Share of the rows of a column of times that are earlier than the one before: more is another column. A
choice: such rows are refused by their number."""
EVEN_STEPS = 0.01
"""Share by which the steps of a column may differ for it to be asked whether it holds the times. A
choice: it fills a draft alone."""
SAME_MOTION = 0.9
"""Correlation from which a column is the rate of another one."""
RADIANS_AT_MOST = 13.0
METRES_AT_MOST = 0.6
MILLISECONDS_AT_LEAST, MICROSECONDS_AT_LEAST, NANOSECONDS_AT_LEAST = 0.5, 50.0, 50_000.0
"""Magnitudes from which a unit is asked for: an angle of two turns or less may be in radians, a length
below 0.6 in metres, a step of 0.5 and more between samples in milliseconds, and so on. They fill a draft
alone, as a question."""
