"""What a diagnosis leaves open of a rig: rigs that are drawn from it, and bands of their tip error."""
