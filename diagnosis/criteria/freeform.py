"""Laws that no library holds (freeform/)."""

CLOSED_GAP = 1.1
FREE_LAW_GAIN, FREE_LAW_LEAVES = 0.95, 0.25
"""Gap on unseen trials up to which a free-form law closes it, and times the gap of the library's nearest
explanation that it has to come below to be told; or, where that is near the noise, times the variance
that it leaves beyond it. Choices: no verdict rests on them."""
LAW_OPEN = 1.0
"""Variance of a prediction, in that of the noise, from which the trials of its fit tell nothing of a law
there. Physical: as much as the noise. In five logs of the twenty-seventh rig any limit from 0.05 to 2
leaves the gap the same to 0.06."""
PATIENCE, FREEDOM = 0.1, 4.0
"""Inverse of the power by which what a free-form law leaves weighs for its place; and parameters that
weigh as a factor of e. Choices: far above the noise 10 % more have a seventh of the weight."""
FLOOR = 0.1
"""Variance beyond the noise, in that of the noise, that hardly counts in these weights. A choice."""
COMPANION, CHOICE = 4.0, 2.0
"""Parameters that an effect or a law beside a law counts for in these weights, as two things are then
missing; and the choice of a plain law among some. Choices."""
SECOND, LEAST_WEIGHT = 0.5, 0.01
"""Weight of the place of a law beside the leading one, in that of the leading one; and that of a place
that no law favours. Choices."""
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
NOISE_LEFT = 0.9
"""Coloured noise beside the nearest explanation, times which a law that closes the gap leaves at most,
before laws are fitted anew in that. A choice: in noise that is larger by a tenth, fits are as good.
Measured, the less of both sensors: 0.55 to 0.82 in three logs of a rig with white noise."""
