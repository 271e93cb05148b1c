"""What a log is checked for once it has been read: signs, units, lengths, repeats."""
