"""The needle in MuJoCo: protocols, runs with and without a controller, recordings."""
