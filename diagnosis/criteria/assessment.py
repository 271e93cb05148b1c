"""What is told beside the verdict (assessment/)."""

MOST_OF_NEAREST = 3
"""Effects of the nearest explanation at most. A choice: no verdict rests on it."""
STEP_LEAVES = 0.8
"""Share of the cost that one more effect of it may leave: that is a tenth of the residual. A choice: no
verdict rests on it."""
DETECTION_SIGMA = 1.645
"""Derived: an effect that exceeds what is asked by so many standard deviations is seen in 95 of 100."""
HIDDEN_MOVES = 3.0
"""Widths of its interval by which an effect that may go unseen has to move a named parameter to be told.
A choice: it adds a warning, and no verdict rests on it."""
HIDDEN_SHARE = 0.2
"""The same as a share of the strength of the named effect. A choice."""
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
DIFFERING_SHARE = 0.4
"""Share of the power beyond noise that values of a parameter of its own in each part of a log have to
take off what the nearest explanation leaves, to be told as a difference of the parts. What is missing
acts otherwise in each trial, too, whose motions differ: measured 0.06 to 0.32 in 19 of 22 logs of a rig
whose constants stay, and 0.43, 0.48 and 0.79 in three whose law is found; 0.22, 0.48 and 0.53 by trial,
and 0.7 and 1.0 by motion, in real rigs that differ. No verdict rests on it."""
DIFFERING_SHOWN = 0.1
"""The same share for the values to be shown at all. A choice."""
INTERVAL_Z = 1.959964
"""Derived: 95 % of a normal distribution."""
CONFIDENCE = 0.95
"""Of the joint region of two parameters, as of every interval."""
CERTAIN_PROBABILITY = 0.999
"""Probabilities above it are told as above it: no library has everything."""
SHOWN_PROBABILITY = 0.0005
"""Probabilities below it round to 0.000, and are not told."""
KNOWN_WELL = 0.02
"""Width of a 95 % interval / the value, below which no run is proposed to narrow it. A choice: no rig
keeps a value to a hundredth."""
WORTH_A_RUN = 0.9
"""Times its interval to which a further run has to bring a parameter to be proposed for that alone: a
tenth is the least that anybody sees."""
