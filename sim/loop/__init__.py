"""The hardware around a simulated needle: delays, sensors and the drive's servo."""
