"""The uncertainty that a diagnosis leaves: rigs drawn from its posterior, bands of their tip error."""
