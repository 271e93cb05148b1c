"""The colour and the drift of noise (prepare/noise/)."""

COLOUR_WINDOW_S = 2.0
"""Length of the windows from which the spectrum of noise is taken."""
COLOUR_WINDOWS = 12
"""Windows at least."""
COLOUR_ABOVE_HZ = 1.5
"""Frequency from which on it is looked at: above, effects leave little."""
COLOUR_LONGEST_S = 0.3
"""Physical: what is correlated for longer is drift and not noise."""
COLOUR_CHI_SQUARE = 20.0
"""Noise is coloured where white noise alone fits its spectrum worse by so much chi-square (derived: of
two more parameters, once in 20 000 sensors by chance)."""
COLOUR_LEAST_SHARE = 0.2
"""And where so large a share of its variance is: what a right explanation leaves passes for less."""
COLOUR_AT_ONCE_SHARE = 0.5
"""The same of what the nominal rig leaves: what effects leave of it passed for 0.2 to 0.5 in 5 of 187
sensors with white noise and for more in one."""
COLOUR_OPEN = 4.0
"""Chi-square of the best within which colours are open."""
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
COLOUR_MOST_PARTS = 3
"""Correlated parts that noise may have, each for COLOUR_CHI_SQUARE."""
COLOUR_OSCILLATES_ABOVE_HZ = 4.0
"""Frequency from which on it may oscillate. Physical: a needle is turned by hand or drive at less than
4 Hz, and what a model lacks there must not pass for noise."""
COLOUR_PARTS_GAP = 2.0
"""What the residual of a sensor may come to for more than one part: the swinging of a rig must not pass
for noise either. Of a friction damper with play, 3 sigma of it were noise of 5 Hz."""
COLOUR_MOST_ORDER = 24
"""Values before that an autoregression of the noise may use: white noise through a Butterworth filter of
fourth order takes 7 to 23, through one of second order 24 and more, of which the last hardly tell."""
COLOUR_LEAST_PART = 0.05
"""Share of the variance that each part of the noise has to have at least. A choice."""
COLOUR_OSCILLATOR = 6.0
"""Chi-square by which an oscillator has to be better than a process: three for each of its two more
parameters, a choice."""
COLOUR_WEAK_CHI_SQUARE = 10.0
"""Chi-square that is enough where only that explains the log (derived: once in 150 sensors)."""
COLOUR_WEAK_GAP = 1.3
"""What white noise may leave of such a colour: that of half of the variance leaves 1.4."""
OTHER_COLOUR_GAP = 1.1
"""Residual that a leading explanation may leave in noise of 1/f, or of a colour that shows less, before
it is fitted in it: a needle that lacks nothing else left 1.00 and 1.05 in two such logs, and 1.1 is what
is asked of free-form laws."""
FLICKER_ABOVE_HZ = 0.5
"""The frequency from which on noise of 1/f is looked for that begins near 1 Hz: three waves of it in
windows of 6 s."""
FLICKER_COMMON_SIGMA = 3.0
"""Correlation of what is left of tip and torque, in its standard deviations, that noise of two sensors
may have by chance (derived: once in 370)."""
FLICKER_EXPONENTS = (1.0, 1.2)
"""Powers of 1 / f that flicker noise may have. One log that lacks nothing had the second, and 1 / f left
means over seconds 1.6 times as large; steeper noise would hide more of what effects leave. A choice."""
COLOURED_BLOCK_S = 2.0
"""Blocks whose means have to be those of noise, too, where it is coloured: seven times the longest
correlation time, so that they are as good as independent. Coloured noise is strong where effects are,
and SLOW_BLOCK alone, some tenths of a second, would not see them."""
SWINGS_CHANCE = 1e-6
"""Chance of a line in the spectrum of white residuals, from which coloured noise is none. Measured:
above 0.1 in 4 logs with coloured noise, 1e-51 of dry friction in pulses."""
SWINGS_SHARE = 0.06
"""And the share of that line in the variance before they were whitened. Measured: 0.013 to 0.045 in
those logs, 0.10 and 0.24 of dry friction in pulses."""
SWINGS_LEAST_PERIODS = 5.0
"""Periods of such a line in a trial, at least. A choice."""
LEAST_GAP = 0.7
"""Derived: noise alone leaves a residual of 1 sigma, to a few per cent; far less is no fit but another
unit (prepare/noise/sensor_noise.py). The nominal rig left 0.98 and more on practice logs."""

DRIFT_SIZES_SIGMA = (0.25, 0.5, 1.0, 2.0, 4.0)
"""Physical: what a sensor of a lab drifts by within a trial, in sigma of its noise: the likeliest of
these is allowed for."""
DRIFT_ALLOWED_SIGMA = (2.0, 4.0)
"""Before that is known: one of these, the second where the first explains nothing."""
DRIFT_FASTEST_S = 0.75
"""Period of the fastest shape of a drift of DRIFT_SIZE_OF_FASTEST beside the noise of a sample."""
DRIFT_SIZE_OF_FASTEST = 2.0
"""In sigma; larger drifts have faster shapes, in proportion."""
DRIFT_MOST_SHAPES = 160
"""Shapes at most: of a random walk so many leave 0.2 sigma."""
DRIFT_START_SIGMA = 3.0
"""Standard deviations by which every trial has to begin off zero, or all of them on average, for a drift
to be as good as an offset: derived, by chance once in 400 logs of a sensor that was zeroed before the
first trial."""
