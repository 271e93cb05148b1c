"""Every number that decides something in the diagnosis, in one place: a module for each of its folders.

Each states its scale, its origin, and the logs that it was set on. There are three kinds of origin:

  derived    follows from noise statistics or from the method; no log was used
  physical   beyond the limits of any rig of this kind, and far from what real ones do
  set on     chosen on logs, which are named; a score on these logs does not test it

A score is -2 log(likelihood) plus penalties: a difference of s means odds of exp(s / 2) to 1. Sigma is
one standard deviation of a sensor's noise. Costs are sums of squared residuals / sigma.

Numbers of a numerical method that decide nothing (windows, differences, iterations) stay with it.
"""
