"""Every number that decides something in this study, with its scale and its origin.

"Chosen" means chosen for this study by argument, with the 28 printed figures known: there is no
second set of published figures on which a choice could have been tested.
"""

# --- Standard deviations of the figures -----------------------------------------------------

RELATIVE_SIGMA = 0.05
"""Of a figure of Tables IV and V, relative. The paper prints none. Chosen: a damping that scatters
as Table II does at these depths (7 %) moves settling and integral by about this much."""

SCANNED_SIGMAS = (0.03, RELATIVE_SIGMA, 0.1, 0.2)
"""Relative, of Tables IV and V: the choice above, and values on both sides of it for which the
report counts the explanations that would pass."""

LARGEST_SIGMA = 2.0
"""Relative, of Tables IV and V: where the search for the least sigma that saves a fit ends. With
more, a figure does not even give its own sign."""

TEXT_LAG_SIGMA_DEG = 1.5
TEXT_SETTLING_SIGMA_S = 0.3
TEXT_LAG_LEFT_SIGMA = 0.15
TEXT_ERROR_LEFT_SIGMA_DEG = 3.0
"""Of "a lag of about 10 deg", "the settling time of nearly 2 s", and what is left of the lag where
it is to "snap near to the final base angle". Chosen: 15 % of 10 deg, of 2 s, of the lag; and 3 deg,
within which the paper calls a tip settled, of what is left of a turn after 6 s. No fit uses them."""

PROPOSED_HELD_TORQUE_SIGMA_N_MM = 0.01
PROPOSED_DAMPING_SIGMA_N_MM_S = 0.05
PROPOSED_LAG_LEFT_SIGMA = 0.1
PROPOSED_SETTLING_SIGMA_S = 0.1
PROPOSED_INTEGRAL_SIGMA_DEG_S = 3.0
"""Of experiments that are proposed. Chosen, for sensors like the paper's (torques are printed to
0.01 N mm) and about 5 % of a settling of 2 s and an integral of 60 s deg at 20 cm."""

# --- Whether a fit is consistent with its figures -------------------------------------------

LEAST_P_VALUE = 0.05
"""Of the chi-square of a fit, below which the fit is rejected. The usual level: one right
hypothesis in 20 is rejected."""

RESOLVED_SIGMA = 2.0
"""Residual in standard deviations within which a single figure counts as explained: 95 % of a
normal distribution, as LEAST_P_VALUE."""

TWIST_RELATIVE_SIGMA = 0.02
"""Of the torque of the twist test, relative. Chosen: the torque is printed to 0.4 %, the length of
41 cm to 1 %."""

TWIST_SIGMAS = 3.0
"""Standard deviations by which a hypothesis may miss the twist test. Chosen: the usual three, so that
only a shaft that is clearly stiffer or softer (by more than 6 %) is ruled out."""

INTERVAL = 0.95
"""Probability that an interval of a parameter contains the true value (tested by simulation)."""

# --- What the fits allow to be concluded ----------------------------------------------------

EQUIVALENT_AICC = 6.0
"""Difference of AICc up to which two explanations are equivalent: exp(6 / 2) is odds of 20 to 1,
the level of LEAST_P_VALUE."""

SEPARATED_SIGMAS = 3.0
"""Standard deviations by which two predictions must differ for an experiment to separate them.
Two figures with equal standard deviation differ by that much by chance in 3 % of cases."""

# --- Accuracy of replays and fits, small beside one standard deviation -----------------------

QUICK_STEP_S = 0.025
BRISK_STEP_S = 0.02
SLOW_STEP_S = 0.1
ELEMENTS = 4
"""Time steps and elements along the inserted shaft. With these the replay is within 0.05 standard
deviations of one with steps four times as fine and 12 elements (tested with four hypotheses)."""

DIFFERENCE = 1e-3
"""Finite difference, in the units of a fit (a logarithm, or the share of a range)."""

FIT_ITERATIONS = 8
ATTAINABLE_ITERATIONS = 4
"""Gauss-Newton iterations of a fit to all figures, and of one to Table II and one figure more."""

GRADIENT_TOLERANCE = 0.03
MOVE_TOLERANCE = 2e-3
"""Gradient of chi-square / 2 and move at which a fit ends: hundredths of a standard deviation."""

LONGEST_STEP = 1.0
"""Of the linear step that leaves a figure out, in the units of a fit: e-fold, or the whole range.
Beyond, a linear step means nothing."""

LEAST_SENSITIVITY = 1e-12
"""Sum over the figures of (d residual / d parameter)^2 up to which no figure shows the parameter:
(DIFFERENCE / 1000)^2, far below what the replay resolves."""

# --- Figs. 11 and 12 ------------------------------------------------------------------------

INSERTION_SIGMA = 0.1
"""Of a deviation of Fig. 12, relative, beside its rounding to 1 mm. Chosen: one insertion each is
shown, and the paper prints no scatter."""

INSERTION_STEP_S = 0.01
INSERTION_ELEMENTS = 8
"""Time step, and half of the elements of the shaft. With these the deviations are within 0.1 mm of
those with half the step and twice the elements (tested)."""

INSERTION_SCAN = 10
"""Values of a parameter at which the deviation is simulated before it is narrowed down."""

CHANNEL_TOLERANCE_N_MM = 0.01
CHANNEL_ITERATIONS = 40
CHANNEL_RELAXATION = 0.7
"""Agreement between the torque of the prebent tip's channel and the roll that it follows from, and
how it is iterated. A deviation is then within 0.1 mm (tested)."""

COARSE_SCAN = 4
"""As INSERTION_SCAN, where every value needs an iteration of its own."""
