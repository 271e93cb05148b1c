"""The sensors of a rig in a replay: encoder, bearing, filters, delays, clocks, gains."""
