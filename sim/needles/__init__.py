"""Needles side by side: what is kept between runs, and steps without MuJoCo."""
