"""What is told beside the verdict: intervals, detection limits, the next experiment."""
