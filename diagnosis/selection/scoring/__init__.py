"""The score of an explanation: what its parameters cost, and what exact constants are worth."""
