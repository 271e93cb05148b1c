"""The verdict: from ranked candidates to what is concluded, and what it may be instead."""
