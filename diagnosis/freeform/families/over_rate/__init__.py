"""Free laws over the rate at which each piece of shaft slips."""
