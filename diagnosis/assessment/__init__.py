"""What is reported in addition to the verdict: intervals, detection limits, the next experiment."""
