"""Importing a lab's files (lab_files/)."""

REST_LEAST_S = 0.3
"""Window in which a line through the readings of the base has to be level for it to rest. A choice."""
REST_RATE_SIGMA = 4.0
"""Standard deviations of its slope up to which it is level. Derived: beyond once in 16 000 windows by
chance; so is one step of the encoder in the window."""
REST_RATE_SHARE = 0.002
"""Or this share of the fastest turn. A choice."""
REVERSAL_SHARE = 0.05
"""Turn back, of the whole turn, that is a reversal: what is smaller is dither."""
PLATEAU = (0.75, 0.95)
"""Definition: shares of a turn over which the torque of a loop is taken for level."""
FIRST_QUARTERS = (0.1, 0.3)
"""Definition: shares of the way from level to level over which its first line is fitted."""
LAST_QUARTERS = (0.7, 0.9)
"""The same of its last line."""
BRANCH_LEAST_NOISE = 10.0
"""Definition: least change of torque of a loop that is fitted, in its noise."""
SIGN_LEAST_WORK = 0.1
"""Share of the moved work below which a sign or an offset is not guessed. A choice."""
SIGN_LEAST_CORRELATION = 0.3
"""Correlation below which it is not guessed either. A choice."""
TIP_LEAST_CORRELATION = 0.7
"""Correlation with the base's angle from which a column is told as one that may be the tip's. Measured:
0.73 to 1.00 in the trials of examples/rig-log and examples/rig-log-dry; it fills a comment of a draft
alone."""
ZERO_SIGMA = 4.0
"""Derived: a mean at rest that is off 0 by fewer of its standard deviations reads 0."""
CLOCK_LONGEST_S = 5.0
"""Longest offset of a clock that is looked for. A choice."""
CLOCK_STEP_S = 0.01
"""Step of the offsets that are looked at. A choice."""
CLOCK_BLOCKS = 8
"""Blocks of which one is left out at a time, to tell how certain an offset is. A choice."""
CLOCK_SIGMA = 4.0
"""Standard deviations from which an offset is one. A choice."""
CLOCK_LEAST_S = 0.1
"""Seconds from which it is one: a needle is not one spring, and lags by itself."""
CLOCK_LEAST_CORRELATION = 0.7
"""Least correlation that is believed. A choice."""
TIP_LAG_AT_MOST_S = 2.0
"""Physical: lag up to which the tip may be slow by itself."""
ALIKE_PEAKS = 0.9
"""Share of the highest product from which another one is about as high: of these the smallest offset is
taken. A choice."""
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
"""Angle up to which it may be in radians: two turns. As all magnitudes below, it fills a draft alone, as
a question."""
METRES_AT_MOST = 0.6
"""Length up to which it may be in metres."""
MILLISECONDS_AT_LEAST = 0.5
"""Step between samples from which it may be in milliseconds."""
MICROSECONDS_AT_LEAST = 50.0
"""The same in microseconds."""
NANOSECONDS_AT_LEAST = 50_000.0
"""The same in nanoseconds."""

# Runs: several recordings in one file (lab_files/runs.py)

MOST_RECORDINGS = 200
"""Recordings of one file at most: a column that changes more often counts samples. A choice."""
RUN_LEAST_ROWS = 20
"""Rows of a recording at least. A choice: what is shorter is no trial."""
