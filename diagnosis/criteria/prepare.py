"""Preparing a log for replay (prepare/)."""

AVERAGED_ABOVE_HZ = 220.0
"""Samples a second from which means are diagnosed in their place: two a window and more. A choice."""
AVERAGING_S = 0.01
"""Window of these means: a step of the replay."""
AVERAGED_LEAST_SHARE = 0.5
"""Share of its samples that a window has to have. A choice."""
ALIKE_RATES = 1.5
"""Longest median step of a trial / the shortest, above which there are no means: less leaves windows two
thirds of their samples."""
STEADY_DEPTH_MM = 0.2
"""A depth that changes by less is constant: what is left is the reading of the stage."""
GAP_STEPS = 1.7
"""Median steps that are a gap, between one sample and two."""
GAP_SHORT_S = 0.15
"""Gaps in which a motion has no time for more than a curve through both sides shows. A choice."""
GAP_MISFIT = 3.0
"""Noise of that curve beyond which none fits. A choice."""
GAP_LONG_S = 0.4
"""Gaps in which a motion may have turned there and back. A choice."""
GAP_CERTAIN_DEG = 0.2
"""Where a curve through the readings on both sides is uncertain by more, the readings after the gap are
not used for a while; after a long gap, until the slowest mode of the needle has taken what is uncertain
below that. Set on blind logs of seeds 1 and 2, as the next three."""
GAP_FORGOTTEN_S = 1.0
"""How long they are not used: by then the needle has mostly relaxed."""
GAP_FORGOTTEN_LENGTHS = 5.0
"""Or this many lengths of a short gap."""
GAP_SIDE_SAMPLES = 12
"""Readings on each side that the curve goes through at most."""
GAP_LOST_DEG = 1.0
"""Uncertainty beyond which dry friction keeps a gap in mind. A choice."""
GAP_ERASED_TWISTS = 2.0
"""Usual twists of the shaft by which the base has to turn one way until that is over. Derived: then all
of the shaft slides the same way (return-point memory)."""
GAP_USUAL_TWIST = 0.9
"""Quantile of the twist of a held shaft that is the usual one: beyond are outliers and what a fast turn
left. A choice."""
GAP_HELD_DEG_S = 5.0
"""Physical: rate below which the base holds, beside a needle's turns of tens of degrees a second."""
GAP_UNKNOWN_TWIST_DEG = 15.0
"""Physical: the usual twist where the tip is not measured; a larger one discards more readings."""
STRAIGHT_DEG = 0.1
"""What the step of the base may change by from sample to sample where it is straight."""
COARSE_STEP_SIGMA = 2.0
"""Derived: steps of twice the noise add a sixth to it, 1 / sqrt(12) of each; below, noise hides them."""
COARSE_LEAST_RUNS = 20
"""Short runs of equal readings that a coarse sensor shows: an exact ramp without noise has none."""
COARSE_LEAST_KINDS = 2
"""Or different multiples of a step that a reading moves by: such a ramp moves by one step."""
SHAKEN_STEP_SIGMA = 3.0
"""Derived: noise shakes a reading across steps, and its mean stays off by
q / pi exp(-2 (pi sigma / q)^2): a tenth of sigma at three, seven tenths at five."""
HELD_S = 0.12
"""Time in which the means of a coarse reading that stands still change by less than a step. Set on two
logs that were rounded, as the next two: it leaves 1.16 and 1.18 as slow part; all readings left 2.34."""
HELD_STEPS = 1.0
"""Steps by which they change less."""
HELD_COUNTED_S = 0.5
"""How often a reading that stands still counts."""
SMOOTHING_SIGMA = 3.0
"""Confidence of a window's value, standard deviations. Set on a practice log with a rubbing sheath."""
REVERSAL_SIGMA = 1.0
"""Swing of the smoothed base below which it does not turn, in noise of its encoder. Derived: means of
five and more samples are within one standard deviation."""
STANDSTILL_SIGMA = 2.0
"""Where it turns, it rests as long as n values are within so many times noise / sqrt(n) of their middle.
Set on ramps, smooth turns and sines of which the true motion is known, as the next: a bearing's friction
comes out 0.3 % too high where it was 2 to 14 %, and sines are left as they were."""
STANDSTILL_SAMPLES = 17
"""Fewest of these values: a sine has a top that is as flat for some samples."""
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
"""First readings of the tip through which a parabola is laid, to see a late start. A choice."""
START_SIGMA = 5.0
"""Standard deviations of its intercept by which it begins off the base. 94 clean logs came to 3.5 at
most, 60 trials that were cut to 17 and more."""
START_LEAST_SIGMA = 3.0
"""Noise of one reading by which it begins off, too, since noise may not be white. A choice."""
START_OUTLIER_SIGMA = 5.0
"""Noise beyond which one of these readings is an outlier. A choice."""
START_TORQUE_FACTOR = 2.0
"""Factor within which torque and twist agree. A choice."""
START_MOVING_DEG_S = 5.0
"""Rate of the base at the first sample from which a trial began under way. A choice: a base at rest
scatters by less than 1 deg/s."""
START_OFF_ZERO_DEG = 1.0
"""The same for its angle. A choice: an encoder is zeroed to some tenths of a degree."""
START_FROM_REST = 0.5
"""Share of its mean rate that a base has first if it starts from rest. A choice: a steady turn has 1,
one from rest 0."""
START_DECAYS = 10.0
"""Time constants of the nominal needle's second mode after which a shape of twist that two numbers do
not tell has faded. Derived: 90 deg to 0.004 deg."""
START_MOST_UNUSED = 0.25
"""Largest share of a trial that is left out for that. A choice."""
START_FILTER_DECAYS = 8.0
"""Time constants of a filter of the torque for which it shows what was before a trial that began late
(derived: 300 sigma to 0.1)."""
START_SPREAD_DEG = 90.0
"""One standard deviation of what the base turned by before a late start, about the twist that is read. A
choice, so broad that a second of any trial outweighs it."""
START_LEFT_TIMES = 3.0
"""Slowest time constants of the nominal needle from the first sample on, within which an initial twist
shows. Derived: 5 % of it are left by then."""
START_LEFT_SHARE = 0.5
"""Share of what the best explanation leaves beyond noise that lies within them, from which trials may
begin wound up: what a law leaves is spread over a trial. Measured: 1.07 on a bent needle that had come
to rest before each trial (6 % of the samples), 0.01 and 0.08 on two laws outside the library."""
START_LEFT_BESIDE = 0.25
"""The same where a sensor may drift besides, which is spread over a trial. A choice, between the share
of laws outside the library and a bent needle beside a drift of equal size."""
LEAST_DIFFERENCES = 20
"""Derived: fewer differences tell a scatter to no better than 16 %, 1 / sqrt(2 N)."""
