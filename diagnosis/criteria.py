"""Every number that decides something in the diagnosis, in one place, in the order of its stages.

Each states its scale, its origin, and the logs that it was set on. There are three kinds of origin:

  derived    follows from noise statistics or from the method; no log was used
  physical   beyond the limits of any rig of this kind, and far from what real ones do
  set on     chosen on logs, which are named; a score on these logs does not test it

A score is -2 log(likelihood) plus penalties: a difference of s means odds of exp(s / 2) to 1. Sigma is
one standard deviation of a sensor's noise. Costs are sums of squared residuals / sigma.

Numbers of a numerical method that decide nothing (windows, differences, iterations) stay with it.
"""

# Reading a log: what is refused (log/)

NOMINAL_RANGE = {
    ("needle", "diameter_mm"): (0.05, 100.0),
    ("needle", "shear_modulus_gpa"): (1e-7, 1000.0),
    ("needle", "density_g_cm3"): (0.1, 30.0),
    ("tissue", "damping_n_mm_s_per_mm"): (1e-8, 10.0),
    ("sensors", "tip_angle_noise_deg"): (0.0, 90.0),
    ("sensors", "base_angle_noise_deg"): (0.0, 90.0),
    ("sensors", "base_torque_noise_n_mm"): (0.0, 100.0),
}
"""Physical: beyond these a constant of rig.yaml is in another unit. Other machines than needles are in
it as an equivalent shaft, which may be thick and soft."""
READING_RANGE = {
    "time_s": (-1e11, 1e11),
    "base_angle_deg": (-1e5, 1e5),
    "tip_angle_deg": (-1e5, 1e5),
    "base_torque_n_mm": (-1e4, 1e4),
    "tip_torque_n_mm": (-1e4, 1e4),
    "inserted_mm": (-1e-6, 1000.0),
    "free_mm": (-1e-6, 1000.0),
    "speed_mm_s": (-1000.0, 1000.0),
}
"""Physical: beyond these a reading is in another unit, or a sentinel for a missing value."""
FEWEST_ROWS = 20
MOST_ROWS = 2_000_000
MOST_BYTES_PER_ROW = 250
"""Rows of one trial at least, of all trials together at most (hours at 100 Hz), bytes per row."""
MOST_LOST_ROWS = 100_000
"""Physical: rows that one pause may be long (1000 s at 100 Hz), since they are replayed as if they were
there; a needle has forgotten by then all but what dry friction holds. A longer one ends a trial."""
LONGEST_SAMPLE_S = 5.0
"""Physical: a needle relaxes within seconds; rarer samples tell nothing, and may be in milliseconds."""
SHORTEST_SAMPLE_S = 1e-5
"""Physical: nobody reads an encoder of a needle more than 100 000 times a second: another unit."""
LEAST_DEPTH_MM = 1.0
"""Derived: READING_RANGE ends at 1000 mm, so that all lengths in metres are below this."""
SHORTEST_SHAFT_DIAMETERS, SHORTEST_SHAFT_MM = 3.0, 30.0
"""Physical: a shaft is longer than one or the other, unless in metres; needles have 50 to 500
diameters."""
LENGTH_JUMP_MM, LENGTH_HOLD_S = 5.0, 1.0
"""Physical: what a length may change by between two samples, beside its travel in so long a hold."""
WRAP_PERIODS_DEG = (360.0, 180.0)
WRAP_REMAINDER = 1 / 6
WRAP_MOTION_SIGMA = 6.0
WRAP_FLICKERS, WRAP_HELD = 3, 1 / 36
"""A wrap of an angle: its periods; share of one by which motion may change the jump; standard deviations
by which the motion on both sides is certain; returns in a row that are no lone spike, and the share of a
period by which noise may change these while the angle holds (10 deg of a turn: seven sigma of 1 deg)."""
NAME_LIKENESS = 0.75
"""Likeness, 0 to 1, from which a name is taken for a misspelling of another. Set on the spellings in
tests/diagnosis/log/test_unit_hints.py; it decides on the wording of an error alone."""

# Time stamps that jitter (log/times/even_times.py)

EVEN_MOST_STEPS = 1.0
"""Steps by which stamps may be off an even grid, root mean square: beyond, the grid has lost count."""
EVEN_TELLING_SIGMA = 3.0
EVEN_SIGMA = 6.0
"""Derived: a sample tells which axis is the true one where both disagree by three of their standard
deviations; samples have to tell for even times by six of those of a fair coin, once in 10^9 logs."""

# Samples taken unevenly under even stamps (log/times/sampling_jitter.py)

JITTER_CERTAIN_SIGMA = 10.0
JITTER_MOST_ALIKE = 0.2
JITTER_MOST_BEYOND = 0.03
JITTER_LEAST_STEPS, JITTER_MOST_STEPS = 0.02, 0.45
"""Certainty with which the scatter of the base grows with its rate (root of twice the log-likelihood),
correlation from sample to sample that is none of jitter, share of samples beyond four sigma, and steps
that it may be. Six logs of the third rig with such a jitter: 17 to 90, -0.15 to 0.03, at most 0.008, and
0.08 to 0.27; 58 without: at most 9, with a correlation of 0.9, and 0.005. Pulses of an exact base: 0.08
beyond. Under half a step samples keep their order."""

# Sensor faults: which readings are set aside (log/faults)

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
PULSES_SHARE = 0.5
"""Share of the outliers of the base that others answer to, from which they are motion; by chance
those of two sensors meet in some hundredths of them."""

# Consistency: columns that no passive needle can have produced together (log/checks/consistency.py)

LARGE_TURN_DEG = 20.0
"""Physical: smaller motions are not judged; noise and play of a rig are far below."""
UNEXPLAINED_OPPOSITE, UNEXPLAINED_SAME = 0.2, 0.6
"""Shares of variance that a lagging copy of wrong and of right sign leaves where a sign is refused. A
log with right signs leaves a small share under the right one, so that both are far from it."""
SWAPPED_SHARE = 1 / 8
SWAPPED_LEAST = 0.1
"""Share of variance that is left if columns change places, over that as they are named, and the least of
the latter that is looked at."""
TWIST_CORRELATION = 0.5
"""Correlation of torque and twist: near 1 on a passive shaft, negative where a sign is wrong."""
NEGATIVE_WORK = -0.2
"""Physical: share of the moved work; a passive needle gives back less than it got, so 0 and above."""
DISTINCT_NOISES = 4.0
"""Ratio of two claimed noises from which their scatter tells two columns apart: twice NOISE_RATIO."""
NOISE_RATIO = (0.5, 2.0)
"""Derived: a scatter within these of a claim agrees with it. Claims are good to 15 %, estimates 2 %."""
BACKWARD_TRAVEL_MM, BACKWARD_SHARE = 5.0, 0.2
"""Physical: depth that changes by more, against the speed, to within this share of it."""
TORQUE_OVER_TWIST = 5.0
"""Physical: torque over what twists the nominal shaft; friction near the chuck gives up to about 2.
Where the tip is not measured, over what the swing of the base does: 1.43 at most in 94 logs."""

# Scales: what is in another unit than the rig's own (log/checks/)

TORQUE_UNDER_NOMINAL = 1 / 8
"""Torque over the least that a motion asks of the nominal needle: 0.34 and more in 94 logs of rigs with
and without unmodelled effects. Angles in rad with torque in N m leave 1/17 of it, N m alone 1/1000."""
SCALE_SIGMA = 10.0
"""Claimed noise of the torque that this least has to exceed before it is judged."""
LAG_UNDER_NOMINAL, LAG_OVER_NOMINAL = 1 / 12, 100.0
"""Lag of the needle over the nominal one, between minutes (1/60) or milliseconds (1000) and what a rig
may be: damping that is off, delays and friction make it late, hardly anything early."""
LAG_UNEXPLAINED = 0.1
LAG_DISTINCT = 3.0
"""Share of variance that the lag may leave, and times that (or 1 %) that lags near the nominal leave:
1.05 times at most in the same 94 logs."""

# Plausibility: what is used with a warning (log/checks/plausibility.py)

PAUSE_STEPS, PAUSE_STEPS_UNEVEN = 10.0, 30.0
UNEVEN_QUARTILES = 1.5
COMMON_PAUSES = 0.05
"""Median steps that are a pause, of evenly and of unevenly sampled logs (quartiles 1.5 x apart); from
5 % of long steps they are the log's way of sampling."""
REST_SAMPLES = 10
REST_SIGMA = 5.0
STILL_SIGMA = 3.0
"""Start off rest: mean of so many readings, in its standard deviations, while the base is still."""
LENGTH_SLACK_MM, LENGTH_SLACK = 2.0, 0.2
"""By which free length and integrated speed may disagree: absolute, and as a share of the travel."""
TIP_TURNS_AT_MOST, TIP_TURNS_AT_LEAST = 20.0, 0.03
"""Turn of the tip over that of the base; beyond, one of them is in radians (57) or revolutions."""
TIP_QUIET = 0.1
TURN_LEAST_DEG, TURN_LEAST_SIGMA = 1.0, 20.0
"""Of the claim, below which a tip that hardly turns has another unit; base motions that are judged."""
LEAST_FREE_SHAFT_MM = 20.0
"""Physical: shaft that a torque twists at least; tissue holds the rest."""

# Importing a lab's files (lab_files/)

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

# Preparing a log for replay (prepare/)

AVERAGED_ABOVE_HZ = 220.0
AVERAGING_S = 0.01
AVERAGED_LEAST_SHARE, ALIKE_RATES = 0.5, 1.5
"""Samples a second from which means over a hundredth of a second, a step of the replay, are diagnosed in
their place; the share of its samples that a window has to have; and the longest median step of a trial /
the shortest, above which there are no means: less leaves their windows two thirds of their samples."""
STEADY_DEPTH_MM = 0.2
"""A depth that changes by less is constant: what is left is the reading of the stage."""
GAP_STEPS = 1.7
"""Median steps that are a gap, between one sample and two."""
GAP_SHORT_S = 0.15
GAP_MISFIT = 3.0
GAP_LONG_S = 0.4
"""Gaps in which a motion has no time for more than a curve through both sides shows; its noise, beyond
which no curve fits; and gaps in which it may have turned there and back."""
GAP_CERTAIN_DEG = 0.2
GAP_FORGOTTEN_S = 1.0
GAP_FORGOTTEN_LENGTHS = 5.0
GAP_SIDE_SAMPLES = 12
"""Where a curve through the readings on both sides (12 each at most) is uncertain by more, the readings
after the gap are not used for a second, or five lengths of a short gap: by then the needle has mostly
relaxed; and longer after a long one, until the slowest mode of the needle has taken what is uncertain
below that. Set on blind logs of seeds 1 and 2."""
GAP_LOST_DEG = 1.0
GAP_ERASED_TWISTS = 2.0
"""Beyond a degree of uncertainty dry friction keeps a gap in mind, until the base has turned one way by
twice the usual twist of the shaft: then all of the shaft slides the same way (return-point memory)."""
GAP_USUAL_TWIST = 0.9
GAP_HELD_DEG_S, GAP_UNKNOWN_TWIST_DEG = 5.0, 15.0
"""Quantile of the twist of a held shaft that is the usual one: beyond are outliers and what a fast turn
left. Physical: rate below which the base holds beside a needle's turns of tens of degrees a second, and
the usual twist where the tip is not measured; a larger one discards more readings after a gap."""
STRAIGHT_DEG = 0.1
"""What the step of the base may change by from sample to sample where it is straight."""
COARSE_STEP_SIGMA = 2.0
COARSE_LEAST_RUNS, COARSE_LEAST_KINDS = 20, 2
"""Derived: steps of twice the noise add a sixth to it, 1 / sqrt(12) of each; below, noise hides them.
And short runs of equal readings, or different multiples of a step that a reading moves by, either of
which a coarse sensor shows: an exact ramp without noise has no short runs, and moves by one step."""
SHAKEN_STEP_SIGMA = 3.0
"""Derived: noise shakes a reading across steps, and its mean stays off by
q / pi exp(-2 (pi sigma / q)^2): a tenth of sigma at three, seven tenths at five."""
HELD_S, HELD_STEPS = 0.12, 1.0
HELD_COUNTED_S = 0.5
"""A coarse reading whose means change by less than a step in so long stands still, and counts so often.
Set on two logs that were rounded: it leaves 1.16 and 1.18 as slow part; all readings left 2.34."""
SMOOTHING_SIGMA = 3.0
"""Confidence of a window's value, standard deviations. Set on a practice log with a rubbing sheath."""
REVERSAL_SIGMA, STANDSTILL_SIGMA, STANDSTILL_SAMPLES = 1.0, 2.0, 17
"""Swing of the smoothed base below which it does not turn, in noise of its encoder: means of five and
more samples are within one standard deviation. Where it turns, it rests as long as n values are within
so many times noise / sqrt(n) of their middle, and not for fewer samples: a sine has such a top too.
Set on ramps, smooth turns and sines of which the true motion is known: a bearing's friction comes out
0.3 % too high where it was 2 to 14 %, and sines are left as they were."""
TORQUES_OF_UNIT_SCALE_N_MM = (0.01, 30.0)
"""Physical: half the range of the torque on rigs for which the library's bounds are written. Beyond,
bounds follow the measured torque instead of the nominal stiffness."""
FASTEST_NEEDLE_RAD_S = 20.0
"""Physical: needles are turned by at most 10 rad/s; bounds on rates grow for rigs that turn faster."""
INERTIA_COUNTS_SIGMA = 0.05
"""Torque of inertia over the noise of the torque from which the motion of the base is interpolated by a
spline. Derived: a twentieth of sigma adds 0.1 % to a gap; the paper's needle is at 0.001 and below."""
INERTIA_LOST_SIGMA = 0.5
"""Part of that torque that samples half as frequent would lose, from which a warning is given."""
INSERTED_AT_LEAST = 0.1
"""Physical: share of its logged depth that the shallowest trial really had; nobody is off by more."""
START_LOOK_S = 0.25
START_SIGMA, START_LEAST_SIGMA = 5.0, 3.0
START_OUTLIER_SIGMA = 5.0
START_TORQUE_FACTOR = 2.0
"""A late start: a parabola through the first readings of the tip begins off the base by so many standard
deviations of its intercept, and of one reading, since noise may not be white. Torque and twist agree
within the last factor. 94 clean logs came to 3.5 at most, 60 trials that were cut to 17 and more."""
START_MOVING_DEG_S, START_OFF_ZERO_DEG, START_FROM_REST = 5.0, 1.0, 0.5
"""Rate and angle of the base at the first sample from which a trial began under way, and the share of
its mean rate that a base has first if it starts from rest. Choices: an encoder is zeroed to some tenths
of a degree, a base at rest scatters by less than 1 deg/s; a steady turn has 1, one from rest 0."""
START_DECAYS = 10.0
START_MOST_UNUSED = 0.25
"""Time constants of the nominal needle's second mode after which a shape of twist that two numbers do
not tell has faded (derived: 90 deg to 0.004 deg), and the largest share of a trial that is left out."""
START_FILTER_DECAYS = 8.0
"""Time constants of a filter of the torque for which it shows what was before a trial that began late
(derived: 300 sigma to 0.1)."""
START_SPREAD_DEG = 90.0
"""One standard deviation of what the base turned by before a late start, about the twist that is read. A
choice, so broad that a second of any trial outweighs it."""
START_LEFT_TIMES, START_LEFT_SHARE = 3.0, 0.5
"""Slowest time constants of the nominal needle from the first sample on, and the share of what the best
explanation leaves beyond noise that lies within them, from which trials may begin wound up. Derived: of
an initial twist 5 % are left by then; what a law leaves is spread over a trial. Measured: 1.07 on a bent
needle that had come to rest before each trial (6 % of the samples), 0.01 and 0.08 on two laws outside
the library."""
LEAST_DIFFERENCES = 20
"""Derived: fewer differences tell a scatter to no better than 16 %, 1 / sqrt(2 N)."""

COLOUR_WINDOW_S, COLOUR_ABOVE_HZ = 2.0, 1.5
COLOUR_WINDOWS = 12
COLOUR_LONGEST_S = 0.3
COLOUR_CHI_SQUARE = 20.0
COLOUR_LEAST_SHARE = 0.2
COLOUR_AT_ONCE_SHARE = 0.5
COLOUR_OPEN = 4.0
"""Noise is coloured where white noise alone fits its spectrum worse by so much chi-square (derived: of
two more parameters, once in 20 000 sensors by chance) and so large a share of its variance is: what a
right explanation leaves passes for less. What effects leave of the nominal rig passed for 0.2 to 0.5 in
5 of 187 sensors with white noise and for more in one, so that there half of it is asked for.
The spectrum is taken from at least so many windows of so many seconds, from the frequency on above which
effects leave little; colours within so much chi-square of the best are open. Physical: what is
correlated for longer is drift and not noise."""
UNEVEN_ROWS = 0.1
"""Spread of the middle half of the steps between rows / their median, from which noise may be correlated
from row to row rather than in time. Derived: below, rows lie nearly evenly and both are the same."""
COLOUR_MOST = 3.0
"""Coloured noise / the larger of the claim and of the scatter from sample to sample, at most, where
these two agree: then the noise is white as claimed. What a late torque and friction in the bearing left
of the nominal rig passed for twelve times the claim, and hid both."""
COLOUR_FAR_ABOVE_CLAIM = 30.0
"""Scatter from sample to sample / claim from which readings have no coloured noise: nobody is that wrong
about a sensor, so that it is the rig that shakes. A friction damper with play, whose load cell is 34
times better than its torque scatters, left all that no model explains to noise of 9 and 13 Hz, and
20 N mm of the 25 of its dry friction."""
COLOUR_MOST_PARTS, COLOUR_OSCILLATES_ABOVE_HZ, COLOUR_PARTS_GAP = 3, 4.0, 2.0
"""Correlated parts that noise may have, each for COLOUR_CHI_SQUARE; the frequency from which on it may
oscillate; and what the residual of a sensor may come to for more than one part. Physical: a needle is
turned by hand or drive at less than 4 Hz, and what a model lacks there must not pass for noise. Nor must
the swinging of a rig: of a friction damper with play, 3 sigma of it were noise of 5 Hz."""
COLOUR_MOST_ORDER = 24
"""Values before that an autoregression of the noise may use: white noise through a Butterworth filter of
fourth order takes 7 to 23, through one of second order 24 and more, of which the last hardly tell."""
COLOUR_LEAST_PART, COLOUR_OSCILLATOR = 0.05, 6.0
"""Share of the variance that each part of the noise has to have at least, and by how much chi-square an
oscillator has to be better than a process: three for each of its two more parameters, a choice."""
COLOUR_WEAK_CHI_SQUARE, COLOUR_WEAK_GAP = 10.0, 1.3
"""Chi-square that is enough where only that explains the log (derived: once in 150 sensors by chance),
and what white noise may leave of such a colour: that of half of the variance leaves 1.4."""
FLICKER_GAP, FLICKER_ABOVE_HZ, FLICKER_COMMON_SIGMA = 1.1, 0.5, 3.0
"""Residual that a leading explanation may leave in noise of 1/f before it is fitted in it: a needle that
lacks nothing else left 1.00 and 1.05 in two such logs, and 1.1 is what is asked of free-form laws. The
frequency from which on noise of 1/f is looked for that begins near 1 Hz: three waves of it in windows of
6 s. And the correlation of what is left of tip and torque, in its standard deviations, that noise of two
sensors may have by chance (derived: once in 370)."""
COLOURED_BLOCK_S = 2.0
"""Blocks whose means have to be those of noise, too, where it is coloured: seven times the longest
correlation time, so that they are as good as independent. Coloured noise is strong where effects are,
and SLOW_BLOCK alone, some tenths of a second, would not see them."""
SWINGS_CHANCE, SWINGS_SHARE, SWINGS_LEAST_PERIODS = 1e-6, 0.06, 5.0
"""Chance of such a line in the spectrum of white residuals, and its share of the variance before they
were whitened, from which coloured noise is none; periods in a trial. Measured: in 4 logs with coloured
noise the share is 0.013 to 0.045, with chances above 0.1; of dry friction in pulses 0.10 and 0.24, at
1e-51."""
LEAST_GAP = 0.7
"""Derived: noise alone leaves a residual of 1 sigma, to a few per cent; far less is no fit but another
unit (prepare/noise/sensor_noise.py). The nominal rig left 0.98 and more on practice logs."""

DRIFT_SIZES_SIGMA = (0.25, 0.5, 1.0, 2.0, 4.0)
DRIFT_ALLOWED_SIGMA = (2.0, 4.0)
DRIFT_FASTEST_S, DRIFT_SIZE_OF_FASTEST = 0.75, 2.0
DRIFT_MOST_SHAPES = 160
"""Physical: what a sensor of a lab drifts by within a trial, in sigma of its noise: the likeliest of
these is allowed for, and before that is known one of two, the second where the first explains nothing;
period of the fastest shape of a drift of up to that size beside the noise of a sample, faster in
proportion for more; shapes at most: of a random walk so many leave 0.2 sigma."""
DRIFT_START_SIGMA = 3.0
"""Standard deviations by which every trial has to begin off zero, or all of them on average, for a drift
to be as good as an offset: derived, by chance once in 400 logs of a sensor that was zeroed before the
first trial."""
# Where the residual is (residuals/)

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

# Noise floor (fitting/noise_floor.py, fitting/noise_reestimation.py)

GAP_LIMIT = 1.03
"""Root mean square of residual / sigma at the noise floor. Numerical error below a tenth of sigma adds
0.005; noise of the base angle that returns as torque the rest. White residuals measured 0.98 to 1.02 on
practice logs, unexplained ones 6 and more."""
SLOW_BLOCK = 25
SLOW_LIMIT = 1.25
"""The same of means of so many samples, scaled by the square root of these. White residuals measured
0.95 to 1.07, unexplained ones 30 and more."""
FLOOR_SIGMA = 3.5
"""Derived: standard deviations of both under chance, which widen the limits where samples are few: one
white residual in 4000 is above."""
NOISE_TRUST = 0.08
"""Noise re-estimated from the residual may differ from the first estimate (good to 2 %) by this share;
beyond, something fast is left in the residual."""
NOISE_LEAST_WEIGHT, NOISE_LEAST_ROWS = 0.8, 200
"""Noise is estimated where readings have this weight at least, if there are so many of them: where a
prediction is not exact, what is left is not all noise. Derived: its error is then 0.75 sigma at most;
the noise of 200 white readings is told to 5 %."""
NOISE_HEAVY, NOISE_HEAVIEST = 1.05, 1.4
"""Standard deviation of noise / that of its core, from which its tails are heavy, and by which they may
add to that at most. Measured: normal noise of 1200 samples came to 1.04 in 1 of 400. Student's t with 3
degrees of freedom, the heaviest whose variance scatters little, comes to 1.3, with a scatter of 0.06."""

BASE_NOISE_GAP, BASE_NOISE_READINGS, BASE_NOISE_MORE = 2.0, 4, 2.0
"""Gap up to which it is asked what of a residual above the floor the noise of the base's encoder makes,
a choice that saves time; and simulated readings of the encoder, of which the one that changes most
counts: a real one changes more once in five logs, and the limits beside it have room for that. None
changes more than the last times another one."""

# What a rig may be off by without a name (fitting/nuisance.py)

SCATTER = {"stiffness_error": 0.015, "damping_error": 0.015}
"""One standard deviation, as a fraction, of what a rig's own constants are off by. A choice: nothing in
a log tells a true error of 3 % from an inaccurate constant."""
EXACT = 0.001
"""The same of a rig whose constants were measured well. A choice: a third of what is told of them alone
(SCATTER_LEAST), and three times what two simulations of the same rig differ by."""
SCATTER_NAMED = 2.0
"""Standard deviations of that scatter beyond which it is named beside other effects."""
SLIDING_MM_S = 0.05
"""Axial speed from which the needle counts as sliding."""

# Selecting an explanation (selection/)

SIMPLE_LEAD = 10.0
"""Score by which unrelated or richer explanations have to lead: odds of 150 to 1."""
LATE_LEAD = 10.0
"""Part of a lead that does not count where trials began late: their past is taken to be one turn, and
what the true one leaves may favour either. A choice; one log was told wrongly by a lead of 11.3."""
EQUAL_SCORE = 0.1
"""Score by which two explanations of the same size differ that no log can tell apart: odds of 1.05 to 1,
what fits leave of their tolerance."""
NESTED_LEAD = 5.0
"""Score by which an effect has to lead one that it contains, or that one it: odds of 12 to 1. Derived:
where the simple one is true it leads by what the further freedom of the other costs, 2 log(samples),
about 18, less a chi-square of two: it is ahead by less than 5, which is undecided, twice in 1000. Weak
forms of the richer one (selection/equivalence/weak_forms.py) may come nearer: 5 to 8 behind strong dry
friction in 3 of 15 logs, ahead of weak one as often as behind. Set on seeds 6, 9, 774 and 775."""
SCATTER_CERTAIN_SIGMA = 5.0
SCATTER_LEAST = 0.003
"""Stiffness or damping alone is named if it is off for certain, and by ten times what two simulations of
the same rig differ by."""
SHIFT_LIMIT, CLEAR_SHIFT = 12.0, 1.5
"""Held-out shift statistic, 1 is expected. What is true comes to 9.4 at most where stick and slip is
rough (250 blind logs), what only mimics it to 15, 21, 39, 45. Set on seeds 1, 2 and 5. And by how much
it is clearly above its limit: then an imperfection of a sensor beside it changes nothing. A choice."""
HELD_OUT_GAP = 5.0
"""Gap on held-out trials, by fits to the others, that no explanation may leave. What is true left up to
2.6 where one trial tells most of it (1000 blind logs); stiction in place of dry friction 367, once."""
WORTH_FITTING = 6.0
"""Cost that an effect has to promise before it is fitted: a chi-square of one exceeds it in 1.4 %."""
SECOND_LEAVES = 0.99
"""Share of the cost that one more effect beside one or two at the floor may leave: half a per cent of
the gap. By chance a second takes up to 0.33 % of the gap off in 420 logs, 0.65 % once."""
NEAR_FLOOR = 3.0
"""Times the cost at the floor: what promises to leave more is not fitted any more beside what is at the
floor, and no finer mesh is spent on it."""
PROMISE_BROKEN = 1.3
"""Times the cost that screening promises: a fit that leaves more begins once more, with nothing taken
over by stiffness and damping, since the linear model that it began from is far from true."""
SLOPES_OF_ITS_OWN = 1.15
"""Gap up to which a fit to the log ends with slopes from runs as fine as it is, since it may explain the
log; slopes from half as fine ones lead there, and are good enough above. A choice that saves time."""
MOST_PAIRS, PAIR_BASES, FITS_AT_ONCE = 20, 6, 4
"""Pairs that are fitted, leading single effects that they build on, fits between two looks."""
MOST_TRIPLES, TRIPLE_BASES, TRIPLE_OTHERS, TRIPLE_SHARE = 12, 4, 12, 0.5
"""Sets of three that are fitted, leading pairs that they build on, further ones where none of those has
a third, and the share that a third effect has to promise of what the pair leaves beyond noise: the true
one takes off all of it, and promised 0.83 to 1 on 7 blind logs of seed 77."""
EXCHANGE_GAP, MOST_EXCHANGED = 1.5, 6
"""Gap of a leading set of two or three effects up to which one of them is exchanged for others, and sets
of which one is exchanged that are fitted. A choice: what imitates one of three effects leaves little."""
WORTH_THE_LOG = 0.05
"""Share that a richer set has to take off what the set that it builds on leaves beyond noise, on the
decimated log, before it is fitted to the log itself, where nothing explains that: the true one takes off
all but the error of the coarse needle, which rough friction makes up to 0.8 of the cost at the floor."""
MOST_QUIETENED = 4.0
"""Physical: what a filter in a sensor may divide its claimed noise by; more is a claim that is wrong."""
DRIFT_SHARE = 0.3
"""Of what an explanation leaves beyond noise: what a drift has to take off before it is allowed for."""
DRIFT_PROMISED_GAP = 1.15
"""Residual that slopes have to promise beside a drift, in sigma, before all is fitted again. Measured:
at most 1.04 in 12 logs that a drift explains, 1.17 to 1.78 in 9 searches of logs that it does not."""
FAULT_CONTENDERS, FAULT_PAIRS = 12, 4
"""Leading explanations of the decimated log that are fitted with a drift, or with jumps of a reading;
half of them single effects: without it these leave more than any pair of which one effect does what it
does; and how many pairs with the leading one that have not led without it."""
JUMP_SHARE, JUMPS_SHARE, JUMP_LEAST_SAMPLES, MOST_JUMPS = 0.3, 0.8, 20, 3
"""Of what an explanation leaves beyond noise: what a jump of a reading has to take off before it is
allowed for, and what it has to take off times those that may still be made, since the largest comes
first; samples on either side of it, of which 20 tell a jump of one sigma; jumps of a log at most.
Choices; the search tries them last."""
JUMP_PARAMETERS = 3.0
"""Parameters that a jump of a reading counts for beside a drift: its trial, its time and its size."""
DRIFT_RANGE_SIGMA, DRIFT_ALIKE_SIGMA, DRIFT_ONE_COURSE_SIGMA, DRIFT_ALIKE = 15.0, 6.0, 3.0, 0.3
"""Physical: a choice of what a working sensor drifts by within a trial, in sigma of its noise: half of
it to one side and the other; more is no roughness but a fault, and the answer stays unknown. So it does
for less where the drift is a line of one rate in all trials, to that share: that is a law. Another
course that is the same in all trials is so even more. Set on one log, of a base that turns by 9 sigma in
each trial."""
DRIFT_OF_TIP_ALONE_SIGMA = 4.0
"""What a tip sensor may drift by over all trials where nothing but an offset of it is missing: noise
that is correlated over seconds wanders so far. More, or another zero in each trial, is itself what the
model lacks, and is told as the law that is missing. A choice, below four logs of two rigs whose tip
sensor drifts, jumps, depends on the depth or is zeroed by hand (4.7 to 9 sigma), above noise (1.6)."""
DRIFT_MOST_EFFECTS = 1
"""Effects that an explanation may name beside a drift, but for those of the other sensor. Of 13 logs of
three rigs that two effects and a drift explained one was so; the others had one effect, or a law that is
in no library."""
DRIFT_FOLLOWS_SIGMA = 5.0
"""Standard deviations of the axial speed in what a drift takes up, or of another course that a law of
the sensor has (selection/scoring/followed): derived, by chance in one of 10^5 logs. Six blind logs with
a drift of the torque: at most 2.5; a torque sensor that feels the axial force: 6.7. 24 own logs with a
drift of the tip by 3 to 7 sigma: at most 3.7."""
IMPERFECT_BASES = 4
"""Leading explanations with an imperfection of a sensor, to which another one is added."""
FINALISTS, MOST_FINALISTS = 4, 8
CONTENDING = 60.0
"""Candidates that are fitted on the log itself: so many at least, and up to the second number those
within SIMPLE_LEAD of the best on the decimated log, of which a weak effect has many. And the score
behind the best beyond which they are out of the question: six times the largest lead that any decision
asks for, since the decimated log weighs costs to 5 % only."""
PART_LEAD, NEARLY = 30.0, 1.1
"""Score by which an explanation has to lead a part of it at the noise floor, for every effect more, if
that shifts over trials, samples are means, or the part is above the floor by up to this factor: one more
effect may take up what a replay does not resolve. A choice; in 4000 samples, an effect of 0.1 sigma."""
UNRESOLVED_SHARE = 1e-4
"""Share of a reading that no model of a needle resolves. Measured: independent solvers of the contract
differ by 1e-5 to 2e-4 of the torque; a choice for rigs, which are no better."""
LAG_ALONE_SIGMA = 1.0
"""Standard deviation of the sum of squares of noise by which a delay has to be behind a filter beside
which nothing is missing: no model of a rig is known to less. A choice."""
LAG_LITTLE = 1.0
"""Sigma of a reading, root mean square of its change, below which a filter of a sensor beside effects
does little: whether it is a filter or a delay is then no second cause, and does not make the effects
undecided. A choice: as much as noise."""
NOMINAL_LEAD = 10.0
"""Cost by which scatter of stiffness and damping has to improve on the exact nominal rig to be told."""

# What no log can tell apart (selection/equivalence/)

EQUIVALENT_SIZE, EQUIVALENT_FITS = 3, 3
EQUIVALENT_LEAVES = 0.01
"""Effects of an equivalent set at most, sets of one size that are fitted, and share of what the chosen
explanation changes, as a sum of squares, by which the two may differ: a tenth as an amplitude. Beside
it SIMPLE_LEAD is the largest cost, which is the smaller from a gap of 1.03 sigma on; without the share
a weak effect would have the whole library for company. A choice; no log was looked at."""
EQUIVALENT_PART = 0.5
"""Share of the rest that one more effect of a set may leave: what takes less off is none."""

# How fine a replay has to be (replay/, selection/stages/mesh_refinement.py)

REFINE_SIGMA = 0.1
REFINE_SHARE = 0.25
"""A finer replay matters if it changes a trial by a tenth of sigma (which makes 1.12 of the slow part,
whose limit is 1.25) and by this share of the sum of squares beyond noise. Set on seed 10."""
DECIMATION_SIGMA = 0.5
"""By how much of the noise the nominal rig on the decimated log may differ from that on the log. Usual
logs: 0.05 to 0.45; set on a rig with turns of several hertz and little noise, 0.9 to 3.4, where two
causes were missed for it, and where windows half as long are off by 0.2 to 0.5."""
LONG_LOG_S, WIDE_SIGMA = 150.0, 0.25
"""Length of a log, all trials together, above which windows are twice as long where the coarse needle
still follows to half of that: a choice that saves time, as such a log has readings to spare."""
FINEST_ELEMENTS, FINEST_STEP_S = 48, 0.0025
NUMERICAL_ERROR_WARNED = 0.14
"""Derived: numerical error of so much of sigma adds 1 % to a gap at the floor."""

# What is told beside the verdict (assessment/)

MOST_OF_NEAREST = 3
STEP_LEAVES = 0.8
"""Effects of the nearest explanation at most, and the share of the cost that one more may leave: a tenth
of the residual. A choice: they decide on what is told of an unknown log, and on no verdict."""
DETECTION_SIGMA = 1.645
"""Derived: an effect that exceeds what is asked by so many standard deviations is seen in 95 of 100."""
HIDDEN_MOVES, HIDDEN_SHARE = 3.0, 0.2
"""Widths of its interval, and share of its strength, by which an effect that may go unseen has to move a
named parameter to be told. Choices: they add a warning, and decide on no verdict."""
DECISIVE_SIGMA = 5.0
"""Separation at which one run of a proposed experiment decides."""
MOST_RUNS = 100
"""Repetitions of a proposed experiment beyond which it is not proposed."""
SAME_DEPTH_MM = 1.0
"""Depths of trials that differ by less tell nothing of what varies with depth."""
ALMOST_NOTHING_SIGMA = 0.015
"""Reduction of the gap by another effect that the report calls almost nothing: half of what GAP_LIMIT
leaves above the noise; of gaps above the noise, this share of them."""
RESOLVED_SHARE_OF_SAMPLE = 0.02
"""A delay whose interval begins below this share of a sample may as well be absent. Set on logs of
several independent rigs: delays that were named, and were none, began below 0.003 of a sample."""
DIFFERING_SHARE, DIFFERING_SHOWN = 0.4, 0.1
"""Share of the power beyond noise that values of a parameter of its own in each part of a log have to
take off what the nearest explanation leaves, to be told as a difference of the parts, and to be shown.
What is missing acts otherwise in each trial, too, whose motions differ: measured 0.06 to 0.32 in 19 of
22 logs of a rig whose constants stay, and 0.43, 0.48 and 0.79 in three whose law is found; 0.22, 0.48
and 0.53 by trial, and 0.7 and 1.0 by motion, in real rigs that differ. No verdict rests on it."""
INTERVAL_Z = 1.959964
"""Derived: 95 % of a normal distribution."""
CONFIDENCE = 0.95
"""Of the joint region of two parameters, as of every interval."""
CERTAIN_PROBABILITY = 0.999
SHOWN_PROBABILITY = 0.0005
"""Probabilities above the first are told as that, as no library has everything; those below the second,
which rounds to 0.000, are not told."""
WORTH_A_RUN = 0.9
"""Times its interval to which a further run has to bring a parameter to be proposed for that alone: a
tenth is the least that anybody sees."""

# Laws that no library holds (freeform/)

CLOSED_GAP = 1.1
FREE_LAW_GAIN, FREE_LAW_LEAVES = 0.95, 0.25
"""Gap on unseen trials up to which a free-form law closes it, and times the gap of the library's nearest
explanation that it has to come below to be told; or, where that is near the noise, times the variance
that it leaves beyond it. Choices: no verdict rests on them."""
STEPS_GAIN, STEPS_MOST, STEPS_SHARE = 50.0, 10, 0.9
"""Steps of a reading that begin a law of several: what each takes off the cost at least (by chance 20
once in a thousand logs), how many, and their share of the nominal residual beyond noise: 0.986 of a
torque sensor that zeroes itself, 0.72 to 0.85 of three other laws that ten steps imitate. Choices."""
FINAL_NUMBERS = 90
"""Numbers that free-form laws may have in all that go to the log itself, if they are more than two: each
is a simulation of it. A choice that saves time."""
PLAINER_LEAVES, PLAINER_SETS = 1.02, 2
"""Residual of a set of fewer parameters over that of the best, up to which it is told as the nearest
explanation where both are above FAR_GAP; and how many such sets go to the log itself. Choices: far
above the noise a likelihood that knows noise alone prefers any law with more freedom. No verdict rests
on it."""
AS_NEAR_LEAVES, AS_NEAR_SETS = 1.1, 6
"""Residual on the decimated log over that of the nearest explanation, up to which other sets are told to
come about as near, and how many of them. Choices: no verdict rests on them."""
FAR_GAP = 1.6
"""Gap on the log above which free-form laws are not fitted to their end on it, plain laws are not looked
for in their place, and what comes nearest is checked by runs half as fine. A choice: no verdict rests on
it."""
FAR_STEP = 1.5
"""Gap on held-out trials over that of the fit, from which one step from the fit is doubted, and what
comes nearest, or a free-form law, is fitted to the other trials instead. A choice: no verdict rests on
it."""

# Stopping early (pipeline.py)

REPLAYS_AFTER_STOP = 8.0
"""Replays of the log for which a limit keeps time: one step of a fit, held-out trials of what is at the
floor, predictions. Set on examples/rig-log-dry; it decides on when a search is cut short alone."""
