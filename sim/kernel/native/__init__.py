"""The border to MuJoCo's C structs: where their fields are, and the callbacks that it calls."""
