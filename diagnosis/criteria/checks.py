"""Columns that cannot belong together, other units, and what is used with a warning (log/checks/)."""

# Consistency: columns that no passive needle can have produced together (log/contradictions/)

LARGE_TURN_DEG = 20.0
"""Physical: smaller motions are not judged; noise and play of a rig are far below."""
UNEXPLAINED_OPPOSITE = 0.2
"""Share of variance that a lagging copy of the wrong sign leaves at most where a sign is refused. A
choice, far from a log with right signs, which leaves a small share under the right one."""
UNEXPLAINED_SAME = 0.6
"""Share that one of the right sign leaves at least there. A choice, as above."""
SWAPPED_SHARE = 1 / 8
"""Share of variance that is left if columns change places, over that as they are named, below which they
are refused. A choice."""
SWAPPED_LEAST = 0.1
"""The least share as they are named that is looked at. A choice."""
TWIST_CORRELATION = 0.5
"""Correlation of torque and twist: near 1 on a passive shaft, negative where a sign is wrong."""
NEGATIVE_WORK = -0.2
"""Physical: share of the moved work; a passive needle gives back less than it got, so 0 and above."""
DISTINCT_NOISES = 4.0
"""Ratio of two claimed noises from which their scatter tells two columns apart: twice NOISE_RATIO."""
NOISE_RATIO = (0.5, 2.0)
"""Derived: a scatter within these of a claim agrees with it. Claims are good to 15 %, estimates 2 %."""
BACKWARD_TRAVEL_MM = 5.0
"""Physical: depth that changes by more, against the speed, has another sign than the speed."""
BACKWARD_SHARE = 0.2
"""Share of that travel to within which the speed has to say the opposite. A choice."""
TORQUE_OVER_TWIST = 5.0
"""Physical: torque over what twists the nominal shaft; friction near the chuck gives up to about 2.
Where the tip is not measured, over what the swing of the base does: 1.43 at most in 94 logs."""

OTHER_UNIT_SWING = 5.0
"""Factor within which the swing of a trial in another unit agrees with that unit: below sqrt(57) = 7.6,
the middle between degrees and radians, and above what depth and speed do to a lag. A choice: the scatter
has to agree as well."""

# Scales: what is in another unit than the rig's own (log/checks/)

TORQUE_UNDER_NOMINAL = 1 / 8
"""Torque over the least that a motion asks of the nominal needle: 0.34 and more in 94 logs of rigs with
and without unmodelled effects. Angles in rad with torque in N m leave 1/17 of it, N m alone 1/1000."""
SCALE_SIGMA = 10.0
"""Claimed noise of the torque that this least has to exceed before it is judged."""
LAG_UNDER_NOMINAL = 1 / 12
"""Lag of the needle over the nominal one, between minutes (1/60) and what a rig may be: hardly anything
makes it early."""
LAG_OVER_NOMINAL = 100.0
"""The same between milliseconds (1000) and what damping that is off, delays and friction may do."""
LAG_UNEXPLAINED = 0.1
"""Share of variance that the lag may leave. A choice."""
LAG_DISTINCT = 3.0
"""Times that share (or 1 %) that lags near the nominal leave: 1.05 times at most in the same 94 logs."""

# Plausibility: what is used with a warning (log/checks/plausibility.py)

PAUSE_STEPS = 10.0
"""Median steps that are a pause, of a log that is sampled evenly. A choice: it adds a warning."""
PAUSE_STEPS_UNEVEN = 30.0
"""The same of one that is sampled unevenly. A choice."""
UNEVEN_QUARTILES = 1.5
"""Ratio of the quartiles of the steps from which sampling is uneven. A choice."""
COMMON_PAUSES = 0.05
"""Share of long steps from which they are the log's way of sampling, and no pauses. A choice."""
REST_SAMPLES = 10
"""First readings whose mean tells whether a trial starts at rest. A choice."""
REST_SIGMA = 5.0
"""Standard deviations of that mean by which a start is off rest. A choice: it adds a warning."""
STILL_SIGMA = 3.0
"""The same within which the base is still meanwhile. A choice."""
LENGTH_SLACK_MM = 2.0
"""By which free length and integrated speed may disagree. A choice: it adds a warning."""
LENGTH_SLACK = 0.2
"""The same as a share of the travel. A choice."""
TIP_TURNS_AT_MOST = 20.0
"""Turn of the tip over that of the base; beyond, the base is in radians (57) or revolutions."""
TIP_TURNS_AT_LEAST = 0.03
"""The same, below which the tip is in one of these."""
TIP_QUIET = 0.1
"""Scatter of a tip that hardly turns over its claimed noise, below which it has another unit."""
TURN_LEAST_DEG = 1.0
"""Physical: smaller motions of the base are not judged."""
TURN_LEAST_SIGMA = 20.0
"""Nor are those below so many times the claimed noise, of base or tip. A choice."""
LEAST_FREE_SHAFT_MM = 20.0
"""Physical: shaft that a torque twists at least; tissue holds the rest."""
