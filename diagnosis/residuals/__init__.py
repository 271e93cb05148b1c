"""What is left of readings when predictions are taken off: by part, in frequency and along time."""
