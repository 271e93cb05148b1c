"""Sensor faults: which readings are set aside (log/faults/)."""

FALSE_ALARM_CHANCE = 1e-9
"""Derived: of calling a run of equal readings frozen, per column; one false alarm in 10^9 columns."""
FROZEN_LEAST_RUN = 20
"""Samples of the shortest run that is frozen. A choice."""
FROZEN_LEAST_AGAIN = 5
"""Samples of the shortest beside a longer one. A choice."""
FROZEN_LEAST_S = 0.5
"""Seconds of the shortest. A choice."""
FROZEN_TIMES_USUAL_RUN = 5.0
"""Times the median run of a slow sensor that it is long. A choice."""
LOST_COUNTS_BESIDE = 3
"""Moves of the base on either side of a jump of its reading. A choice: the other sensors decide."""
LOST_COUNTS_SIGMA = 10.0
"""Least size of a jump that is looked at, in what usual moves are beyond those beside them. A choice, as
above."""
LOST_COUNTS_LEAST_DEG = 0.3
"""The same in deg. A choice, as above."""
LOST_COUNTS_STEADY = 0.3
"""Range of the moves on either side of a jump, in its size: more is a turn that gains speed."""
LOST_COUNTS_STEP = 2.5
"""Time from one sample to the next, in the median: more is a gap."""
LOST_COUNTS_MOST = 3
"""Jumps of a log that are looked at, largest first. A choice."""
LOST_COUNTS_LEAVES = 0.9
"""Share of the gap of a trial that shifting readings back has to leave at most: far beyond chance, and
not so little that friction would hide it."""
LOST_COUNTS_FURTHEST = 3.0
"""Scatter of a jump as it was read by which its size may differ from that at most. A choice."""
LOST_COUNTS_SMALL_SIGMA = 4.0
"""Beside an explanation, the least size of a jump, in what usual moves are beyond those beside them. A
choice: what is found counts only where it brings an explanation to the noise."""
LOST_COUNTS_MOST_SMALL = 16
"""Jumps of a trial that are looked at there. A choice."""
LOST_COUNTS_GAIN = 30.0
"""Cost that shifting readings back has to take off there: odds of a million to one. A choice."""
LOST_COUNTS_SHARE = 0.3
"""Share of what the explanation leaves beyond noise that all of this has to take off before the log is
searched again. A choice."""
SATURATED_LEAST_RUN = 20
"""Samples at an end of the range. A choice."""
SATURATED_SHARE = 0.5
"""Their share of the samples near that end. A choice."""
SATURATED_NEAR_SIGMA = 1.5
"""Noise within which a sample is near it. A choice."""
SATURATED_BESIDE = 10
"""Samples on either side that are set aside, too. A choice."""
SLOW_LEAST_SHARE = 0.1
"""Share of rows that are filled in, of a sensor that is slower than the log. A choice: where noise
shakes readings by more than their steps, chance is under that."""
SLOW_TIMES_CHANCE = 3.0
"""The same as a multiple of what chance would do. A choice."""
SLOW_REGULAR_SHARE = 0.7
"""Share of rows between new readings that are evenly apart. A choice."""
HELD_EVIDENCE = 50.0
"""Chi-square by which a reading that is held under noise is likelier than a new one in every row.
Derived: seven standard deviations of the motion's part."""
HELD_SHARE = 0.5
"""The same as a share of what is expected. Derived: of new ones it is as far below 0, so that half of it
is midway between one and none."""
HELD_MOST_ROWS = 6
"""Rows of a hold at most. A choice."""
HUM_MAINS_HZ = (50.0, 60.0)
"""Physical: mains frequencies at which a sensor may hum."""
HUM_HARMONICS = 3
"""Multiples of them at which it may, too. A choice."""
HUM_GRID_HZ = 0.2
"""Physical: how far a grid may be off: it is kept within that."""
HUM_WANDERS_HZ = 0.05
"""Physical: how far the grid is from its usual frequency, from one trial to another."""
HUM_LOWEST_HZ = 5.0
"""Physical: the lowest frequency that sampling may fold a line to: motions are slower."""
HUM_FALSE_ALARMS = 1e-6
"""Derived: of white noise that is called a line, per sensor and multiple."""
SMOOTHED_ZERO = 6.0
"""Times by which the spectrum of readings rises on both sides of a zero, where they were smoothed after
recording: five standard deviations of levels. None of 645 logs that were not smoothed was told as
smoothed, with this and the next six."""
SMOOTHED_ZERO_LEVEL = 0.05
"""Level of that zero in that of the claimed noise, at most."""
SMOOTHED_LEVEL = 0.005
"""The same level, which a Butterworth filter brings the spectrum below."""
SMOOTHED_LEAST_ORDER = 1.4
"""Least order of that filter: motion without noise falls as behind one of first order."""
SMOOTHED_MISFIT = 0.5
"""How far off logarithms of levels are from its curve at most, mean absolute. Of 13 filters 0.07 to
0.37; of the one other log that reached the level, 2.6."""
SMOOTHED_OVER_ROUNDING = 4.0
"""Times the level of rounding below which levels tell nothing. A choice."""
SMOOTHED_SEGMENTS = 8
"""Segments of readings that a spectrum is the mean of at least; they overlap by half. A choice."""
BAND_SHARE = 0.375
"""Corner of the low band of smoothed readings in that of their filter."""
BAND_ROLL_OFF = 0.5
"""How far it rolls off on both sides of its corner, in that corner. Derived: where the band ends, at
0.56 of its filter's corner, a Butterworth filter of second order leaves 0.91."""
BAND_LOBES = 6
"""Lobes of its kernel on either side. A choice."""
BELIEVED_SCATTER = 0.2
"""Times the claim: a sensor that scatters less is filtered, simulated, or in another unit (57 times less
in rad, 1000 in N m), which is told; and repeats prove nothing."""
OUTLIER_FALSE_ALARMS = 0.001
"""Derived: samples of a column of a trial that white noise makes outliers of, on average: a clean log of
five trials has none in 98 of 100. Of 3000 samples that asks for 5.1 sigma."""
OUTLIER_CLEARANCE = 8.0
"""How far an outlier is off, in what its neighbours leave of one curve beyond the noise: a corner comes
to 4."""
OUTLIER_MISFIT = 2.0
"""Times the variance of the noise that they may leave by chance."""
OUTLIER_ONE_SIDED = 0.5
"""Share of that by which it is off each side alone: at a corner, 0 of one side."""
OUTLIER_MOST_BESIDE = 4
"""Samples that a window may do without, itself among them. A choice."""
OUTLIER_MOST_RUN = 5
"""Outliers in a row: what lasts longer is an event. A choice."""
OUTLIER_LEFT_SIGMA = 5.0
"""How far outliers beside an explanation are off. Derived: by chance once in two million readings."""
OUTLIER_LEFT_QUIET_SIGMA = 3.5
"""How far their neighbours are off at most. Derived: one of four is further once in 500 times."""
OUTLIER_LEFT_NEIGHBOURS = 2
"""Neighbours on each side that are quiet. A choice."""
OUTLIER_LEFT_MOST_RUN = 10
"""Outliers in a row, with fewer quiet readings between them: a tenth of a second of most logs, as what
lasts longer is an event. A choice."""
OUTLIER_MOST_LEFT = 0.02
"""Share of a sensor's readings that they come to at most. A choice."""
OUTLIER_LEFT_SHARE = 0.3
"""Share of what is left beyond noise that they have to be. A choice."""
FAULT_LEAST_SHARE = 0.01
"""Of the cost of noise: what an explanation is taken to leave beyond noise at least, of which a drift, a
jump or outliers have to take off a part. A choice: a residual of 1.005 sigma."""
UNSAMPLED_SIGMA = 1.0
"""By which the motion of the base between its samples may matter before readings count for less: as much
as the noise, at the worst of all samples (derived)."""
GROWING_LOG_LIKELIHOOD = 50.0
"""Twice the gain of the logarithm of the likelihood by noise that grows with rate or torque. Derived:
chi-square of one number comes to 16 once in 16 000 sensors of normal noise; a choice, three times that,
for noise of heavy tails."""
GROWING_LEAST = 1.3
"""Noise at the largest rate / that at rest, at least. A choice."""
GROWING_MOST = 20.0
"""The same, at most. A choice."""
GROWING_WHITE = 0.15
"""By which the noise from differences of orders 1 and 4 may differ, where it is large: 3.5 times the
scatter of medians of 600 differences, 3 % and 2.5 %, rounded up for fewer (derived)."""
TRIALS_NOISE_BY_CHANCE = 1e-6
"""Share of sensors whose noise differs as much from trial to trial by chance, if it is normal; of heavy
tails it scatters by a fifth more. A choice."""
TRIALS_NOISE_LEAST = 1.15
"""Largest noise of a trial / the smallest, at least: from there a trial counts by a third more or less
than another. A choice."""
TRIALS_NOISE_WHITE = 0.15
"""By which the noise of a trial from differences of orders 2 and 4 may differ: 3.5 times their scatter
of 200 readings, 4 % (derived)."""
PULSES_SHARE = 0.5
"""Share of the outliers of the base that others answer to, from which they are motion; by chance
those of two sensors meet in some hundredths of them."""
TWIST_BEYOND_SIGMA = 0.5
"""Sigma of a reading of the tip by which shaft beyond the tissue may turn it. A choice: it adds a tenth
to what noise leaves."""
