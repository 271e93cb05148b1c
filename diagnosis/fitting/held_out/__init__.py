"""What a fit predicts on trials that it has not seen."""
