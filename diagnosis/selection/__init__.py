"""Which explanation: screening, the search with its record, and the verdict."""
