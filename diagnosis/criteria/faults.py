"""Sensor faults: which readings are set aside (log/faults/)."""

FALSE_ALARM_CHANCE = 1e-9
"""Derived: of calling a run of equal readings frozen, per column; one false alarm in 10^9 columns."""
FROZEN_LEAST_RUN, FROZEN_LEAST_AGAIN = 20, 5
FROZEN_LEAST_S = 0.5
FROZEN_TIMES_USUAL_RUN = 5.0
"""Shortest run that is frozen: samples, and beside a longer one; seconds, and times the median run of a
slow sensor."""
LOST_COUNTS_BESIDE = 3
LOST_COUNTS_SIGMA, LOST_COUNTS_LEAST_DEG = 10.0, 0.3
"""Moves of the base on either side of a jump of its reading; least size of a jump that is looked at, in
what usual moves are beyond those beside them, and in deg. Choices: the other sensors decide."""
LOST_COUNTS_STEADY, LOST_COUNTS_STEP = 0.3, 2.5
"""Range of the moves on either side of a jump, in its size: more is a turn that gains speed; time from
one sample to the next, in the median: more is a gap."""
LOST_COUNTS_MOST, LOST_COUNTS_LEAVES = 3, 0.9
"""Jumps of a log that are looked at, largest first; share of the gap of a trial that shifting readings
back has to leave at most: far beyond chance, and not so little that friction would hide it."""
LOST_COUNTS_FURTHEST = 3.0
"""Scatter of a jump as it was read by which its size may differ from that at most. A choice."""
LOST_COUNTS_SMALL_SIGMA, LOST_COUNTS_MOST_SMALL = 4.0, 16
LOST_COUNTS_GAIN, LOST_COUNTS_SHARE = 30.0, 0.3
"""Beside an explanation: least size of a jump, in what usual moves are beyond those beside them; jumps
of a trial that are looked at; cost that shifting readings back has to take off: odds of a million to
one; and share of what the explanation leaves beyond noise that all of this has to take off before the
log is searched again. Choices; what is found counts only where it brings an explanation to the noise."""
SATURATED_LEAST_RUN = 20
SATURATED_SHARE = 0.5
SATURATED_NEAR_SIGMA = 1.5
SATURATED_BESIDE = 10
"""Samples at an end of the range; their share of those within 1.5 sigma of it; samples lost beside."""
SLOW_LEAST_SHARE, SLOW_TIMES_CHANCE, SLOW_REGULAR_SHARE = 0.1, 3.0, 0.7
"""A sensor that is slower than the log: share of rows that are filled in, in all and as a multiple of
what chance would do, and share of rows between new readings that are evenly apart. Choices: where noise
shakes readings by more than their steps, chance is under 0.1."""
HELD_EVIDENCE, HELD_SHARE, HELD_MOST_ROWS = 50.0, 0.5, 6
"""A reading that is held under noise: chi-square by which that is likelier than a new one in every row,
also as a share of what is expected; rows of a hold. Derived: of new ones it is as far below 0, so that
half of it is midway between one and none, and 50 is seven standard deviations of the motion's part."""
HUM_MAINS_HZ, HUM_HARMONICS, HUM_GRID_HZ = (50.0, 60.0), 3, 0.2
HUM_LOWEST_HZ = 5.0
"""Mains frequencies and the multiples of them at which a sensor may hum; how far a grid may be off (it
is kept within 0.2 Hz); and the lowest frequency that sampling may fold a line to: motions are slower."""
HUM_FALSE_ALARMS = 1e-6
"""Derived: of white noise that is called a line, per sensor and multiple."""
SMOOTHED_ZERO, SMOOTHED_ZERO_LEVEL = 6.0, 0.05
SMOOTHED_LEVEL, SMOOTHED_LEAST_ORDER, SMOOTHED_MISFIT = 0.005, 1.4, 0.5
SMOOTHED_OVER_ROUNDING, SMOOTHED_SEGMENTS = 4.0, 8
"""Readings that were smoothed after recording. A zero: times by which their spectrum rises on both
sides, five standard deviations of levels, and its own level in that of the claimed noise. A Butterworth
filter: level that is reached, least order (motion without noise falls as behind one of first order),
and how far off logarithms of levels are, mean absolute: of 13 filters 0.07 to 0.37, of the one other
log that reached the level 2.6. Times the level of rounding that tells, and segments of readings that a
spectrum is the mean of, at least; they overlap by half. None of 645 logs that were not smoothed."""
BAND_SHARE, BAND_ROLL_OFF, BAND_LOBES = 0.375, 0.5, 6
"""The low band of smoothed readings: its corner in that of the filter, how far it rolls off on both
sides of that, and lobes of its kernel on either side. Choices: where the band ends, at 0.56 of its
corner, a Butterworth filter of second order leaves 0.91."""
BELIEVED_SCATTER = 0.2
"""Times the claim: a sensor that scatters less is filtered, simulated, or in another unit (57 times less
in rad, 1000 in N m), which is told; and repeats prove nothing."""
OUTLIER_FALSE_ALARMS = 0.001
"""Derived: samples of a column of a trial that white noise makes outliers of, on average: a clean log of
five trials has none in 98 of 100. Of 3000 samples that asks for 5.1 sigma."""
OUTLIER_CLEARANCE = 8.0
OUTLIER_MISFIT = 2.0
OUTLIER_ONE_SIDED = 0.5
OUTLIER_MOST_BESIDE = 4
OUTLIER_MOST_RUN = 5
"""How far an outlier is off, in what its neighbours leave of one curve (a corner comes to 4) beyond the
noise, of which they may leave twice the variance by chance; the share of it by which it is off each side
alone (at a corner, 0 of one side); samples that a window may do without, itself among them; and outliers
in a row: what lasts longer is an event."""
OUTLIER_LEFT_SIGMA, OUTLIER_LEFT_QUIET_SIGMA, OUTLIER_LEFT_NEIGHBOURS = 5.0, 3.5, 2
OUTLIER_LEFT_MOST_RUN = 10
OUTLIER_MOST_LEFT, OUTLIER_LEFT_SHARE = 0.02, 0.3
"""Outliers beside an explanation: how far they are off, while so many neighbours on each side are not
(derived: by chance once in two million readings, and once in 500 neighbours); how many in a row, with
fewer quiet readings between them (a tenth of a second of most logs: what lasts longer is an event); the
share of a sensor's readings that they come to at most; and what they have to be of what is left beyond
noise."""
UNSAMPLED_SIGMA = 1.0
"""By which the motion of the base between its samples may matter before readings count for less: as much
as the noise, at the worst of all samples (derived)."""
GROWING_LOG_LIKELIHOOD, GROWING_LEAST, GROWING_MOST = 50.0, 1.3, 20.0
"""Noise that grows with rate or torque: twice the gain of the logarithm of the likelihood by growing
(derived: chi-square of one number comes to 16 once in 16 000 sensors of normal noise; a choice, three
times that, for noise of heavy tails); noise at the largest rate / that at rest, at least and at most."""
GROWING_WHITE = 0.15
"""By which the noise from differences of orders 1 and 4 may differ, where it is large: 3.5 times the
scatter of medians of 600 differences, 3 % and 2.5 %, rounded up for fewer (derived)."""
TRIALS_NOISE_BY_CHANCE, TRIALS_NOISE_LEAST = 1e-6, 1.15
"""Noise that differs from trial to trial: by chance as much once in so many sensors, of normal noise (of
heavy tails it scatters by a fifth more); largest / smallest, at least, from which a trial counts by a
third more or less than another. Choices."""
TRIALS_NOISE_WHITE = 0.15
"""By which the noise of a trial from differences of orders 2 and 4 may differ: 3.5 times their scatter
of 200 readings, 4 % (derived)."""
PULSES_SHARE = 0.5
"""Share of the outliers of the base that others answer to, from which they are motion; by chance
those of two sensors meet in some hundredths of them."""
