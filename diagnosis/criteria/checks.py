"""Columns that cannot belong together, other units, and what is used with a warning (log/checks/)."""

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
