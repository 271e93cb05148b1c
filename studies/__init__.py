"""What is computed with the simulator, the controllers and the diagnosis together."""
