"""The hardware of a simulated closed loop: delays, sensors and the drive's servo."""
