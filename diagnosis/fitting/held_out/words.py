"""On which trials a residual is, in words."""

SEEN = "on the trials of the fit"
UNSEEN = "on trials that the fit has not seen"
ONLY_TRIAL = "on the only trial, which is also the one that was fitted"
_LEAST_TOLD, _MOST_TOLD = 0.05, 0.95  # of the readings: as good as none, or all


def unseen(determined_share: float) -> str:
    """On which trials a residual is, by the share of readings that the other trials determine."""
    if determined_share <= _LEAST_TOLD:
        return SEEN
    if determined_share >= _MOST_TOLD:
        return UNSEEN
    told = f"{100 * determined_share:.0f} % of the readings"
    return f"{UNSEEN} ({told}; of the rest no other trial tells, and the fit's own residual counts)"
