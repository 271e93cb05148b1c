"""Free laws of the shaft of the needle."""
