"""Laws that no library holds (freeform/)."""

CLOSED_GAP = 1.1
"""Gap on unseen trials up to which a free-form law closes it. A choice: no verdict rests on it."""
FREE_LAW_GAIN = 0.95
"""Times the gap of the library's nearest explanation, below which a law has to come to be told. A
choice: no verdict rests on it."""
FREE_LAW_LEAVES = 0.25
"""The same where that is near the noise, times the variance that it leaves beyond it. A choice."""
LAW_OPEN = 1.0
"""Variance of a prediction, in that of the noise, from which the trials of its fit tell nothing of a law
there. Physical: as much as the noise. In five logs of the twenty-seventh rig any limit from 0.05 to 2
leaves the gap the same to 0.06."""
PATIENCE = 0.1
"""Inverse of the power by which what a free-form law leaves weighs for its place. A choice: far above
the noise 10 % more have a seventh of the weight."""
FREEDOM = 4.0
"""Parameters that weigh as a factor of e there. A choice."""
FLOOR = 0.1
"""Variance beyond the noise, in that of the noise, that hardly counts in these weights. A choice."""
COMPANION = 4.0
"""Parameters that an effect or a law beside a law counts for in these weights, as two things are then
missing. A choice."""
CHOICE = 2.0
"""The same of the choice of a plain law among some. A choice."""
SECOND = 0.5
"""Weight of the place of a law beside the leading one, in that of the leading one. A choice."""
LEAST_WEIGHT = 0.01
"""Weight of a place that no law favours. A choice."""
STEPS_GAIN = 50.0
"""Steps of a reading that begin a law of several: what each takes off the cost at least (by chance 20
once in a thousand logs). A choice."""
STEPS_MOST = 10
"""How many of them at most. A choice."""
STEPS_SHARE = 0.9
"""Their share of the nominal residual beyond noise, at least: 0.986 of a torque sensor that zeroes
itself, 0.72 to 0.85 of three other laws that ten steps imitate. A choice."""
FEW_PROMISE = 0.05
"""Share of the residual beyond noise that a straight start of a law with few numbers leads to, from
which its first fit takes several iterations. A choice that saves time: in nine logs of the thirtieth
rig, of 367 such laws below it none came to half of what the best explains but one, at 0.02, which came
to two thirds."""
THIRD_LAW_GAP = 1.3
"""Gap on the log that two laws leave, up to which a third is looked for. Measured: of 213 unknown logs
none was closed by three laws, and where two leave more, fits of three took up to five minutes."""
FINAL_NUMBERS = 90
"""Numbers that free-form laws may have in all that go to the log itself, if they are more than two: each
is a simulation of it. A choice that saves time."""
OTHER_FORM_PROMISING = 0.998
"""Share of the cost that one step has to leave at most, from an effect to a law of another form, before
that is fitted to its end. A choice that saves time: SECOND_LEAVES is asked for in the end."""
PLAIN_LAW_DETERMINED = 100.0
"""Variance of what a plain law predicts of a trial by the others, in that of the noise, mean over the
trial, up to which they determine it; else its curve predicts, whose prior knows how little they tell. A
choice."""
PLAINER_LEAVES = 1.02
"""Residual of a set of fewer parameters over that of the best, up to which it is told as the nearest
explanation where both are above FAR_GAP: far above the noise a likelihood that knows noise alone prefers
any law with more freedom. A choice: no verdict rests on it."""
PLAINER_SETS = 2
"""How many such sets go to the log itself. A choice."""
AS_NEAR_LEAVES = 1.1
"""Residual on the decimated log over that of the nearest explanation, up to which other sets are told to
come about as near. A choice: no verdict rests on it."""
AS_NEAR_SETS = 6
"""How many of them are told. A choice."""
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
